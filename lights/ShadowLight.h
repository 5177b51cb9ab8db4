#ifndef gnomon_lights_ShadowLight_h
#define gnomon_lights_ShadowLight_h

#include <glm/glm.hpp>

#include <string>

namespace gnomon
{

enum class LightKind
{
  Directional, ///< parallel rays along directionWorld
  Spot         ///< a cone of half angle coneAngleDegrees around directionWorld, from positionWorld
};

/// One light that casts shadows in this frame, in world coordinates and double precision.
struct ShadowLight
{
  LightKind kind = LightKind::Directional;

  /// Position of a spot light; unused by directional lights.
  glm::dvec3 positionWorld{ 0.0 };
  /// Unit vector along which the light travels (the axis of a spot light's cone).
  glm::dvec3 directionWorld{ 0.0, 0.0, -1.0 };
  /// Half the opening angle of a spot light's cone, in degrees, in (0, 90).
  double coneAngleDegrees = 0.0;

  /// Place in the renderer's light collection, counted over all lights.
  int sceneIndex = 0;
  /// Place among the lights that are switched on: the N of VTK's shader uniform lightColorN.
  int shaderIndex = 0;

  std::string technique;
  int mapSizeTexels = 1024;
  /// How much of the light a full shadow takes away, in [0, 1]: shading uses mix(1, v, strength).
  double strength = 1.0;

  /// The unit vector from a point to the light.
  glm::dvec3 directionToLight(const glm::dvec3& pointWorld) const
  {
    return this->kind == LightKind::Directional ? -this->directionWorld
                                                : glm::normalize(this->positionWorld - pointWorld);
  }
};

} // namespace gnomon

#endif
