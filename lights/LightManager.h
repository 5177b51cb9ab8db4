#pragma once

#include "lights/ShadowLight.h"
#include "lights/vtkGnomonVersions.h"

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

/// A light that is left out in this frame, and why.
struct SkippedLight
{
  int sceneIndex = 0; ///< place in the renderer's light collection
  std::string reason; ///< a whole clause for people, e.g. "switched off"
};

/// The frame's lights that were asked for, and those of them that are left out.
struct LightSet
{
  std::vector<ShadowLight> lights;
  std::vector<SkippedLight> skipped;
  bool headlightIsAlone = false; ///< a headlight was skipped because it is the only light
};

/// Reads the renderer's vtkLights as they are at this moment.
///
/// Head and camera lights are taken through their transform, which the renderer's
/// UpdateLightsGeometryToFollowCamera() must have set for this frame. Lights that cannot show a
/// shadow are left out with a reason: switched off, black, no intensity, marked as not casting,
/// strength 0, and those whose numbers give no light (a cone without angle, an empty box, an
/// endless area). A headlight that is the only light is left out unless it is marked as casting:
/// its shadows hide behind what casts them. How large a light is follows from the setting
/// `light_radius`, else from vtkGnomonAreaLight, else from OSPRay's key for it.
///
/// Textures of lights are kept until the next frame: an image is read once, however many lights
/// have it, and again when it has changed.
class LightManager
{
public:
  /// @param defaults what lights fall back on where they say nothing themselves
  /// (vtkGnomonLightKeys)
  LightSet collect(vtkRenderer* renderer, const ShadowSettings& defaults);

  /// The renderer's lights that shine from more than a point, whether or not they cast shadows, and
  /// those that give light and would if their numbers said how.
  LightSet collectAreas(vtkRenderer* renderer, const ShadowSettings& defaults);

  /// Removes a light's area and its samples. (The area of vtkGnomonAreaLight is the
  /// class's: such a light is exchanged.)
  static void makePoint(vtkLight* light);

private:
  /// What readLightTexture() has made of an image.
  struct ReadTexture
  {
    std::uint64_t modified = 0; ///< the image's MTime
    std::shared_ptr<const LightTexture> texture;
    std::string reason; ///< why it is null
  };
  using ReadTextures = std::map<vtkImageData*, ReadTexture>;

  /// Why a light is left out whatever its numbers say; empty if it is not, nothing if it is not
  /// asked for.
  /// @param isArea whether it shines from more than a point, or would if its numbers said how
  using WhyNot = std::function<std::optional<std::string>(vtkLight* light, bool isArea)>;

  LightSet read(vtkRenderer* renderer, const ShadowSettings& defaults, const WhyNot& whyNot);
  std::shared_ptr<const LightTexture> textureOf(
    vtkLight* light, ReadTextures& current, std::string& reason);

  ReadTextures textures_; ///< of the frame before
};

/// Read one light without a renderer: where it is, and what it reaches. Its area, its texture and its
/// settings are left out.
///
/// @param reason filled with a clause for people where the light's numbers say not where it shines
/// @return nothing in that case
std::optional<ShadowLight> readPlace(vtkLight* light, std::string& reason);

} // namespace gnomon
