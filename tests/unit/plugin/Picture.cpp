#include "Picture.h"

#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <cstdlib>
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
  vtkNew<vtkUnsignedCharArray> values;
  const int* size = window->GetActualSize(); // the tile's size for a tiled window
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 1, values);
  const unsigned char* first = values->GetPointer(0);
  return { size[0], size[1], { first, first + values->GetNumberOfValues() } };
}

std::vector<float> channelsOf(const Picture& picture)
{
  return { picture.rgb.begin(), picture.rgb.end() };
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
