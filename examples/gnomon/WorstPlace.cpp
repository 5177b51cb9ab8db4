#include "WorstPlace.h"

#include <algorithm>
#include <cstddef>

namespace gnomon::tool
{
namespace
{

std::size_t pixelOf(int x, int y, int width)
{
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
    static_cast<std::size_t>(x);
}

double sumOfSquares(const std::vector<float>& differences, const Place& place, int width)
{
  double sum = 0.0;
  for (int y = place.top; y < place.top + place.side; ++y)
  {
    for (int x = place.left; x < place.left + place.side; ++x)
    {
      const double difference = static_cast<double>(differences[pixelOf(x, y, width)]);
      sum += difference * difference;
    }
  }
  return sum;
}

} // namespace

//------------------------------------------------------------------------------
std::optional<Place> worstPlace(
  const std::vector<float>& differences, int width, int height, int side)
{
  side = std::min({ side, width, height });
  const int step = std::max(1, side / 2);
  std::optional<Place> worst;
  double most = 0.0;
  for (int top = 0; top < height; top += step)
  {
    for (int left = 0; left < width; left += step)
    {
      const Place place{ std::min(left, width - side), std::min(top, height - side), side };
      const double sum = sumOfSquares(differences, place, width);
      if (sum > most)
      {
        most = sum;
        worst = place;
      }
    }
  }
  return worst;
}

//------------------------------------------------------------------------------
Picture reduced(const Picture& picture, int mostPixels)
{
  const int block =
    std::max(1, (std::max(picture.width, picture.height) + mostPixels - 1) / mostPixels);
  Picture result;
  result.width = std::max(1, picture.width / block);
  result.height = std::max(1, picture.height / block);
  const int columns = std::min(block, picture.width);
  const int rows = std::min(block, picture.height);
  for (int y = 0; y < result.height; ++y)
  {
    for (int x = 0; x < result.width; ++x)
    {
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        int sum = 0;
        for (int i = 0; i < rows * columns; ++i)
        {
          sum +=
            picture
              .rgb[3 * pixelOf(block * x + i % columns, block * y + i / columns, picture.width) +
                channel];
        }
        result.rgb.push_back(static_cast<unsigned char>(sum / (rows * columns)));
      }
    }
  }
  return result;
}

//------------------------------------------------------------------------------
Picture enlarged(const Picture& picture, const Place& place, int pixelSide)
{
  Picture result;
  result.width = result.height = place.side * pixelSide;
  result.rgb.reserve(3 * result.pixelCount());
  for (int y = 0; y < result.height; ++y)
  {
    for (int x = 0; x < result.width; ++x)
    {
      const auto from = picture.rgb.begin() +
        static_cast<std::ptrdiff_t>(
          3 * pixelOf(place.left + x / pixelSide, place.top + y / pixelSide, picture.width));
      result.rgb.insert(result.rgb.end(), from, from + 3);
    }
  }
  return result;
}

} // namespace gnomon::tool
