#include "Picture.h"

#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <stdexcept>

namespace gnomon::test
{

glm::ivec3 Picture::at(int x, int y) const
{
  const std::size_t first = 3 *
    (static_cast<std::size_t>(y) * static_cast<std::size_t>(this->width) +
      static_cast<std::size_t>(x));
  return { this->rgb.at(first), this->rgb.at(first + 1), this->rgb.at(first + 2) };
}

Picture readPicture(vtkRenderWindow* window)
{
  const int* size = window->GetActualSize(); // the tile's size for a tiled window
  return readPicture(window, { 0, 0 }, { size[0], size[1] });
}

Picture readPicture(vtkRenderWindow* window, const glm::ivec2& lower, const glm::ivec2& size)
{
  vtkNew<vtkUnsignedCharArray> values;
  const glm::ivec2 last = lower + size - 1;
  window->GetPixelData(lower.x, lower.y, last.x, last.y, 1, values);
  const unsigned char* first = values->GetPointer(0);
  return { size.x, size.y, { first, first + values->GetNumberOfValues() } };
}

std::vector<float> channelsOf(const Picture& picture)
{
  return { picture.rgb.begin(), picture.rgb.end() };
}

double rmsDifference(const Picture& a, const Picture& b)
{
  const double squares = std::transform_reduce(a.rgb.begin(), a.rgb.end(), b.rgb.begin(), 0.0,
    std::plus<>(), [](int one, int other) { return (one - other) * (one - other); });
  return std::sqrt(squares / static_cast<double>(a.rgb.size()));
}

std::size_t differingPixels(const Picture& a, const Picture& b, int tolerance)
{
  if (a.rgb.size() != b.rgb.size())
  {
    throw std::invalid_argument("pictures of different sizes");
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
  {
    const auto differs = [&](std::size_t k) { return std::abs(a.rgb[k] - b.rgb[k]) > tolerance; };
    count += differs(i) || differs(i + 1) || differs(i + 2) ? 1 : 0;
  }
  return count;
}

} // namespace gnomon::test
