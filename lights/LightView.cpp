#include "lights/LightView.h"

#include <array>

namespace gnomon
{

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
    outside[0] += clip.x < -clip.w ? 1 : 0;
    outside[1] += clip.x > clip.w ? 1 : 0;
    outside[2] += clip.y < -clip.w ? 1 : 0;
    outside[3] += clip.y > clip.w ? 1 : 0;
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

} // namespace gnomon
