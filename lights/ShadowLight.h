#pragma once

#include "lights/LightArea.h"
#include "lights/LightTexture.h"
#include "lights/ShadowSettings.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>

namespace gnomon
{

enum class LightKind
{
  Directional, ///< parallel rays along directionWorld
  Spot,        ///< a cone of half angle coneAngleDegrees around directionWorld, from positionWorld
  Point        ///< all directions, from positionWorld
};

/// The box that a directional light fills. Its near face is centred on the light's positionWorld
/// and stands across directionWorld; the light enters there and travels `depth` far.
struct LightBox
{
  double width = 0.0;  ///< across the light and across `up`
  double height = 0.0; ///< across the light and along `up`
  double depth = 0.0;  ///< along the light
  /// Which way is up in the near face; not along the light, of any length.
  glm::dvec3 upWorld{ 0.0, 1.0, 0.0 };
};

/// One light that casts shadows in this frame, in world coordinates and double precision, and what
/// is asked of its shadows.
struct ShadowLight : ShadowSettings
{
  LightKind kind = LightKind::Directional;

  /// Position of a spot or point light, middle of the near face of a box; else unused.
  glm::dvec3 positionWorld{ 0.0 };
  /// Unit vector along which the light travels (the axis of a spot light's cone); of no meaning for
  /// a point light.
  glm::dvec3 directionWorld{ 0.0, 0.0, -1.0 };
  /// Half the opening angle of a spot light's cone, in degrees, in (0, 90).
  double coneAngleDegrees = 0.0;
  /// The box of a directional light that does not fill the whole scene.
  std::optional<LightBox> box;
  /// What it shines from around its centre, of a light that is more than a point. Techniques with
  /// hard shadows take the centre; only the centre says what the light reaches: its cone, its box.
  std::optional<LightArea> area;
  /// How its colour is spread over the area; none: evenly. Where there is no area, its mean is what
  /// counts.
  std::optional<PlacedTexture> texture;

  /// Place in the renderer's light collection, counted over all lights.
  int sceneIndex = 0;
  /// Place among the lights that are switched on: the N of VTK's shader uniform lightColorN.
  int shaderIndex = 0;

  /// How much of the light a full shadow takes away, in [0, 1]: shading uses
  /// mix(lit, v, strength), where lit is 1 or the texture's mean.
  double strength = 1.0;

  /// The largest part of its colour times its intensity: what it gives where nothing attenuates it.
  double intensity = 1.0;
  /// Of a light with a position: the light at a distance d is divided by x + y d + z d^2.
  glm::dvec3 attenuation{ 1.0, 0.0, 0.0 };

  /// Whether it is a headlight: it stands at the camera, and lights what the camera sees.
  bool isHeadlight = false;

  /// Whether this frame fits the light's views to the receivers that are drawn, on the GPU
  /// (shadowtech/fitting/), rather than to what the camera's frustum leaves of the scene.
  bool fittedToReceivers = false;
};

/// "light 3": by its place in the scene, for notes and errors.
inline std::string nameOf(const ShadowLight& light)
{
  return "light " + std::to_string(light.sceneIndex);
}

} // namespace gnomon
