#include "view/TexelPicture.h"

#include <algorithm>
#include <cmath>

namespace gnomon::tool
{
namespace
{

/// @param steps log2 of a texel's side in pixels
glm::dvec3 colourOf(double steps)
{
  constexpr double mostSteps = 2.0;
  const glm::dvec3 fine(0.1, 0.3, 1.0);
  const glm::dvec3 even(1.0);
  const glm::dvec3 coarse(1.0, 0.15, 0.1);
  const double share = std::clamp(steps / mostSteps, -1.0, 1.0);
  return glm::mix(even, share < 0.0 ? fine : coarse, std::abs(share));
}

} // namespace

//------------------------------------------------------------------------------
Picture texelPicture(const Picture& picture, const VisibilityImages& images,
  const LightSight& sight, const SceneFrame& frame, const CameraView& camera)
{
  Picture result = picture;
  const glm::dvec2 pixelSide = camera.pixelSide({ images.width, images.height });
  const glm::dvec3 origin(images.origin[0], images.origin[1], images.origin[2]);
  for (std::size_t i = 0; i < images.coverage.size(); ++i)
  {
    unsigned char* const pixel = &result.rgb[3 * i];
    const double grey = (0.21 * pixel[0] + 0.72 * pixel[1] + 0.07 * pixel[2]) / 255.0;
    glm::dvec3 colour(0.5);
    if (images.coverage[i] == 1.0f)
    {
      const glm::dvec3 position = frame.fromWorld(
        origin + glm::dvec3(images.positionX[i], images.positionY[i], images.positionZ[i]));
      const double side = texelSide(sight.views, sight.light.mapSizeTexels, position);
      const double distance = -(camera.viewFromCentred * glm::dvec4(position, 1.0)).z;
      if (side > 0.0)
      {
        colour = colourOf(std::log2(side / (pixelSide.x + pixelSide.y * distance)));
      }
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      pixel[channel] =
        static_cast<unsigned char>(255.0 * colour[channel] * (0.25 + 0.75 * grey) + 0.5);
    }
  }
  return result;
}

} // namespace gnomon::tool
