#pragma once

#include "lights/ShadowLight.h"
#include "lights/vtkGnomonVersions.h"

#include <vtkType.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkLight;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// A light that is skipped in this frame, and the reason.
struct SkippedLight
{
  int sceneIndex = 0; ///< place in the renderer's light collection
  std::string reason; ///< a clause for users, e.g. "switched off"
};

/// The frame's lights that were asked for, and those of them that were skipped.
struct LightSet
{
  std::vector<ShadowLight> lights;
  std::vector<SkippedLight> skipped;
  bool headlightIsAlone = false; ///< nothing casts, as only headlights give light
};

/// Which lights cast, of those whose own key (vtkGnomonLightKeys::CASTS) does not say. A headlight
/// does not: the camera hardly sees its shadows.
enum class Casting
{
  Auto,     ///< those of the scene, and the brightest of those that follow the camera
  All,      ///< all of them
  Brightest ///< one: by intensity times luminance, then by order
};

/// True for a headlight, and for a camera light that stands where one does.
bool isHeadlight(vtkLight* light);

/// Reads the current state of a renderer's vtkLights.
///
/// Headlights and camera lights go through their transform. The renderer's
/// UpdateLightsGeometryToFollowCamera() must have set it for this frame.
///
/// Lights that cannot show a shadow are skipped with a reason: switched off, black, no intensity,
/// marked as not casting, strength 0, or invalid numbers (a cone without angle, an empty box, an
/// infinite area), or not chosen (Casting).
///
/// A light's size comes from the setting `light_radius`, else from vtkGnomonAreaLight, else from
/// OSPRay's key.
///
/// Lights' textures are cached until the next frame. An image is read once for all lights that
/// share it, and again after it is modified.
class LightManager
{
public:
  /// Return the lights that cast shadows, and the skipped ones.
  /// @param defaults settings for lights without their own (vtkGnomonLightKeys)
  LightSet collect(
    vtkRenderer* renderer, const ShadowSettings& defaults, Casting casting = Casting::Auto);

  /// Return the renderer's area lights that give light, whether or not they cast shadows. Area
  /// lights with invalid numbers are among the skipped ones.
  LightSet collectAreas(vtkRenderer* renderer, const ShadowSettings& defaults);

  /// Remove a light's area and sample settings. The area of a vtkGnomonAreaLight belongs to its
  /// class, so callers replace such a light.
  static void makePoint(vtkLight* light);

private:
  /// The result of readLightTexture() for an image.
  struct ReadTexture
  {
    std::uint64_t modified = 0; ///< the image's MTime
    std::shared_ptr<const LightTexture> texture;
    std::string reason; ///< why the texture is null
  };
  using ReadTextures = std::map<vtkImageData*, ReadTexture>;

  /// Returns why a light is skipped for other reasons than its numbers. Empty: it is not skipped.
  /// Nothing: the light was not asked for.
  /// @param isArea true if the light has an area, valid or not
  using WhyNot = std::function<std::optional<std::string>(vtkLight* light, bool isArea)>;

  LightSet read(vtkRenderer* renderer, const ShadowSettings& defaults, const WhyNot& whyNot);
  std::shared_ptr<const LightTexture> textureOf(
    vtkLight* light, ReadTextures& current, std::string& reason);

  ReadTextures textures_; ///< of the previous frame
};

/// Return when a light, or anything that it hands on, last changed: its transform, its keys, their
/// object of settings, its texture.
vtkMTimeType changeTime(vtkLight* light);

/// Read one light's place and reach, without a renderer. Its area, texture and settings are left
/// out.
///
/// @param reason set to a clause for users if the light has no valid place or direction, else empty
/// @return nothing in that case
std::optional<ShadowLight> readPlace(vtkLight* light, std::string& reason);

} // namespace gnomon
