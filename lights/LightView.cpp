#include "lights/LightView.h"

namespace gnomon
{

glm::dmat4 LightView::clipFromCentred() const
{
  const glm::dmat3& map = this->mapFromAcross;
  // Homogeneous across coordinates are (x, y, 1), for a positional light (x, y, z).
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

bool LightView::maySee(const Bounds& centred) const
{
  const glm::dvec2 middle = 0.5 * (this->readable.lower + this->readable.upper);
  const glm::dvec2 half = 0.5 * (this->readable.upper - this->readable.lower);
  glm::dmat4 readableFromClip(1.0); // in units of w
  readableFromClip[0].x = 1.0 / half.x;
  readableFromClip[1].y = 1.0 / half.y;
  readableFromClip[3].x = -middle.x / half.x;
  readableFromClip[3].y = -middle.y / half.y;
  return mayShow(readableFromClip * this->clipFromCentred(), centred);
}

glm::dmat3 texelFromAcross(const glm::dmat3& mapFromAcross, int sizeTexels)
{
  const double half = 0.5 * sizeTexels;
  const glm::dmat3 texelFromMap(half, 0.0, 0.0, 0.0, half, 0.0, half, half, 1.0);
  return texelFromMap * mapFromAcross;
}

glm::dmat3 texelFromAcross(const LightView& view, int sizeTexels)
{
  return texelFromAcross(view.mapFromAcross, sizeTexels);
}

} // namespace gnomon
