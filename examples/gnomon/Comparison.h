#pragma once

#include "Pictures.h"
#include "Scene.h"

#include "plugin/vtkGnomonVisibilityImages.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::tool
{

/// A pixel's verdict. With several lights, the last enumerator applies.
enum class PixelVerdict : unsigned char
{
  NotCounted, ///< covered by nothing, turned away, or outside the cone
  Right,
  Traced, ///< and so right
  FalseShadow,
  FalseLight
};

/// The error of a technique's visibility against the truth, over the pixels that count. These are
/// covered, face the light (facesLight() of ShadowRay.h), and lie inside its cone or box if it has
/// one. With several lights, each pair of pixel and light counts once. A light with a texture
/// counts as three, one for each channel.
struct VisibilityError
{
  std::int64_t facingPixels = 0;  ///< pixels that count
  std::int64_t falseLight = 0;    ///< v - truth > 0.5
  std::int64_t falseShadow = 0;   ///< truth - v > 0.5, or v is NaN
  std::int64_t betweenPixels = 0; ///< neither lit nor dark: strictly inside darkBelow, litAbove
  double meanAbsolute = 0.0;
  double rootMeanSquare = 0.0;
  std::vector<PixelVerdict> verdicts; ///< of each pixel
  /// Each pixel's greatest difference from the truth; 0 for pixels that do not count.
  std::vector<float> differences;

  static constexpr float darkBelow = 0.1f;
  static constexpr float litAbove = 0.9f;

  std::int64_t wrongPixels() const { return this->falseLight + this->falseShadow; }
  /// Return `pixels` as a share of the pixels that count; 0 if none counts.
  double share(std::int64_t pixels) const
  {
    return this->facingPixels > 0
      ? static_cast<double>(pixels) / static_cast<double>(this->facingPixels)
      : 0.0;
  }
};

/// Return a mask with 1 for each pixel that counts for this light.
std::vector<unsigned char> facingPixels(const VisibilityImages& images, const SceneLight& light);

/// Measure a technique's error against the truth, over all lights of the truth.
/// @param lights the scene's lights, indexed by `truth.sceneIndices`
/// @throws std::invalid_argument if the images differ in size or lights
VisibilityError measureError(const VisibilityImages& technique, const VisibilityImages& truth,
  const std::vector<SceneLight>& lights);

/// Return the dimmed picture with false light in blue, false shadow in red and traced pixels in
/// purple.
Picture errorPicture(const Picture& picture, const std::vector<PixelVerdict>& verdicts);

/// The motion while frames are timed.
enum class Motion
{
  Static,
  Camera,
  Light
};
inline constexpr std::array<Motion, 3> allMotions = { Motion::Static, Motion::Camera,
  Motion::Light };
/// The motions' names for users, and their keys in tables.
inline constexpr std::array<const char*, 3> motionNames = { "static", "camera moving",
  "light moving" };
inline constexpr std::array<const char*, 3> motionKeys = { "static", "camera_moving",
  "light_moving" };

inline constexpr const char* plainTechnique = "plain VTK";
inline constexpr const char* shadowMapPassTechnique = "vtkShadowMapPass";

} // namespace gnomon::tool
