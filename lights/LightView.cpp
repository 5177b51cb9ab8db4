#include "lights/LightView.h"

#include <array>

namespace gnomon
{

//------------------------------------------------------------------------------
glm::dmat4 LightView::clipFromCentred() const
{
  const glm::dmat3& map = this->mapFromAcross;
  // Across coordinates are (x, y, 1), of a positional light (x, y, z).
  const glm::dvec4 x(map[0].x, map[0].y, 0.0, map[0].z);
  const glm::dvec4 y(map[1].x, map[1].y, 0.0, map[1].z);
  const glm::dvec4 unit(map[2].x, map[2].y, 0.0, map[2].z);
  const glm::dvec4 none(0.0);
  glm::dmat4 clipFromView =
    this->rays.positional ? glm::dmat4(x, y, unit, none) : glm::dmat4(x, y, none, unit);
  if (this->depthIsAffine())
  {
    clipFromView[2].z = 2.0 * this->depthScale * map[2].z;
    clipFromView[3].z = (2.0 * this->depthOffset - 1.0) * map[2].z;
  }
  return clipFromView * this->rays.viewFromCentred;
}

//------------------------------------------------------------------------------
bool LightView::maySee(const Bounds& centred) const
{
  if (centred.empty())
  {
    return false;
  }
  // Corners outside of each of the planes that bound clip space; near is left to the rasteriser.
  std::array<int, 5> outside{};
  const glm::dmat4 matrix = this->clipFromCentred();
  for (const glm::dvec3& corner : centred.corners())
  {
    const glm::dvec4 clip = matrix * glm::dvec4(corner, 1.0);
    outside[0] += clip.x < this->readable.lower.x * clip.w ? 1 : 0;
    outside[1] += clip.x > this->readable.upper.x * clip.w ? 1 : 0;
    outside[2] += clip.y < this->readable.lower.y * clip.w ? 1 : 0;
    outside[3] += clip.y > this->readable.upper.y * clip.w ? 1 : 0;
    outside[4] += clip.w <= 0.0 ? 1 : 0;
  }
  for (const int corners : outside)
  {
    if (corners == 8)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
glm::dmat3 texelFromAcross(const LightView& view, int sizeTexels)
{
  const double half = 0.5 * sizeTexels;
  const glm::dmat3 texelFromMap(half, 0.0, 0.0, 0.0, half, 0.0, half, half, 1.0);
  return texelFromMap * view.mapFromAcross;
}

} // namespace gnomon
