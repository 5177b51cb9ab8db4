#include "lights/LightTexture.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon
{
namespace
{

/// Return a scalar type's value of white; 0 for types that pictures do not have.
double whiteOf(int scalarType)
{
  switch (scalarType)
  {
    case VTK_UNSIGNED_CHAR:
      return 255.0;
    case VTK_UNSIGNED_SHORT:
      return 65535.0;
    case VTK_FLOAT:
    case VTK_DOUBLE:
      return 1.0;
    default:
      return 0.0;
  }
}

/// Return the mean colour over a part of the picture. A white picture gives exactly 1, as both sums
/// have the same terms.
/// @param halfWidthAt returns the part's half width at a height in [-1, 1], as a share of the
/// picture's
template <typename HalfWidthAt>
glm::dvec3 meanOver(const LightTexture& texture, const HalfWidthAt& halfWidthAt)
{
  constexpr int leastLines = 512;
  const int linesOfRow = (leastLines + texture.height - 1) / texture.height;
  const int lines = linesOfRow * texture.height;
  glm::dvec3 sum(0.0);
  double full = 0.0;
  for (int line = 0; line < lines; ++line)
  {
    const double half = 0.5 * texture.width * halfWidthAt(2.0 * (line + 0.5) / lines - 1.0);
    const double begin = 0.5 * texture.width - half;
    const double end = 0.5 * texture.width + half;
    for (int x = static_cast<int>(begin); x < texture.width && x < end; ++x)
    {
      const double covered = std::min(end, x + 1.0) - std::max(begin, static_cast<double>(x));
      const std::size_t texel =
        static_cast<std::size_t>(line / linesOfRow) * static_cast<std::size_t>(texture.width) +
        static_cast<std::size_t>(x);
      sum += covered * glm::dvec3(texture.texels[texel]);
      full += covered * static_cast<double>(LightTexture::full);
    }
  }
  return sum / full;
}

} // namespace

std::shared_ptr<const LightTexture> readLightTexture(vtkImageData* image, std::string& reason)
{
  const int* const dimensions = image->GetDimensions();
  vtkDataArray* const scalars = image->GetPointData()->GetScalars();
  if (image->GetNumberOfPoints() == 0 || !scalars ||
    scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    reason = "its texture has no points with scalars";
    return nullptr;
  }
  if (dimensions[2] != 1)
  {
    reason = "its texture has " + std::to_string(dimensions[2]) + " slices instead of 1";
    return nullptr;
  }
  const int components = scalars->GetNumberOfComponents();
  if (components < 1 || components > 4)
  {
    reason = "its texture has " + std::to_string(components) + " components instead of 1 to 4";
    return nullptr;
  }
  const double white = whiteOf(scalars->GetDataType());
  if (white == 0.0)
  {
    reason = std::string("its texture has values of type ") + scalars->GetDataTypeAsString() +
      ", expected unsigned char, unsigned short, float or double";
    return nullptr;
  }
  auto texture = std::make_shared<LightTexture>();
  texture->width = dimensions[0];
  texture->height = dimensions[1];
  texture->texels.resize(static_cast<std::size_t>(image->GetNumberOfPoints()));
  for (std::size_t texel = 0; texel < texture->texels.size(); ++texel)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      const double value =
        scalars->GetComponent(static_cast<vtkIdType>(texel), components < 3 ? 0 : channel) / white;
      if (!(value >= 0.0 && value <= 1.0))
      {
        const std::size_t width = static_cast<std::size_t>(texture->width);
        reason = "its texture is " + std::to_string(value) + " at texel (" +
          std::to_string(texel % width) + ", " + std::to_string(texel / width) +
          "), expected 0 to 1";
        return nullptr;
      }
      texture->texels[texel][channel] =
        static_cast<glm::u8>(std::lround(LightTexture::full * value));
    }
  }
  texture->meanOfRectangle = meanOver(*texture, [](double) { return 1.0; });
  texture->meanOfDisk =
    meanOver(*texture, [](double height) { return std::sqrt(1.0 - height * height); });
  return texture;
}

glm::vec3 PlacedTexture::colourAt(const glm::vec3& offset) const
{
  const glm::vec3 place = this->pictureFromWorld * offset;
  const glm::ivec2 size(this->texture->width, this->texture->height);
  const glm::ivec2 texel = glm::clamp(
    glm::ivec2((0.5f * glm::vec2(place) + 0.5f) * glm::vec2(size)), glm::ivec2(0), size - 1);
  return this->texture
    ->texels[static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(size.x) +
      static_cast<std::size_t>(texel.x)];
}

PlacedTexture placeTexture(std::shared_ptr<const LightTexture> texture, LightArea::Shape shape,
  const glm::dvec3& travel, const glm::dvec3& up, const glm::dvec2& halfSize)
{
  // A viewer who faces the light sees its left side on the right.
  const LightArea picture = rectangleArea(travel, up, { -halfSize.x, halfSize.y });
  glm::dmat3 worldFromPicture = picture.worldFromUnit;
  PlacedTexture placed;
  placed.mean =
    shape == LightArea::Shape::Rectangle ? texture->meanOfRectangle : texture->meanOfDisk;
  placed.texture = std::move(texture);
  for (int axis = 0; axis < 2; ++axis)
  {
    const double squared = glm::dot(worldFromPicture[axis], worldFromPicture[axis]);
    worldFromPicture[axis] *=
      squared > 0.0 ? 1.0 / squared : 0.0; // a line has one axis, a point none
  }
  placed.pictureFromWorld = glm::transpose(worldFromPicture);
  return placed;
}

} // namespace gnomon
