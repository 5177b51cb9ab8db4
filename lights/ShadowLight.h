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

/// The box that limits a directional light. Its near face is centred on the light's positionWorld,
/// across directionWorld. The light starts there and ends after `depth`.
struct LightBox
{
  double width = 0.0;  ///< across the light and across `up`
  double height = 0.0; ///< across the light and along `up`
  double depth = 0.0;  ///< along the light
  /// The up direction in the near face; of any length, not along the light.
  glm::dvec3 upWorld{ 0.0, 1.0, 0.0 };
};

/// One light that casts shadows in this frame, in world coordinates and double precision, with its
/// settings.
struct ShadowLight : ShadowSettings
{
  /// The world's length of a unit, in which lengths of this struct are, except those that are
  /// settings (enterFrame()).
  double unitWorld = 1.0;

  LightKind kind = LightKind::Directional;

  /// The position of a spot or point light, or the middle of a box's near face; else unused.
  glm::dvec3 positionWorld{ 0.0 };
  /// The unit vector along which the light travels: the axis of a spot light's cone. Unused for a
  /// point light.
  glm::dvec3 directionWorld{ 0.0, 0.0, -1.0 };
  /// Half the opening angle of a spot light's cone, in degrees, in (0, 90); 0 for other lights.
  double coneAngleDegrees = 0.0;
  /// The box of a directional light; none: the light fills the scene.
  std::optional<LightBox> box;
  /// The emitting area around the light's centre; none: a point. Techniques with hard shadows use
  /// the centre. The light's reach, its cone or box, always starts from the centre.
  std::optional<LightArea> area;
  /// The distribution of the light's colour over the area; none: uniform. For a light without area,
  /// only its mean counts.
  std::optional<PlacedTexture> texture;

  /// The index in the renderer's light collection, counted over all lights.
  int sceneIndex = 0;
  /// The index among the lights that are switched on: N of VTK's shader uniform lightColorN.
  int shaderIndex = 0;

  /// The share of the light that a full shadow removes, in [0, 1]. Shading uses mix(lit, v,
  /// strength), with lit 1 or the texture's mean.
  double strength = 1.0;

  /// The largest channel of the light's colours times its intensity, without attenuation.
  double intensity = 1.0;
  /// The attenuation of a positional light: at distance d in the world, light is divided by x + y d
  /// + z d^2.
  glm::dvec3 attenuation{ 1.0, 0.0, 0.0 };

  /// True for a headlight, which stands at the camera and shines along the view.
  bool isHeadlight = false;

  /// True for a point of an area light, in one of the pictures that are averaged.
  bool isPointOfArea = false;

  /// True if this frame fits the light's views to the visible receivers, on the GPU
  /// (shadowtech/fitting/). Else they are fitted to the scene's part in the camera's frustum.
  bool fittedToReceivers = false;
};

/// Return a light's name for notes and errors, by its index in the scene: "light 3".
inline std::string nameOf(const ShadowLight& light)
{
  return "light " + std::to_string(light.sceneIndex);
}

} // namespace gnomon
