#ifndef gnomon_lights_LightSamples_h
#define gnomon_lights_LightSamples_h

#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// A light's place in centred coordinates: (position, 1), or (unit vector towards it, 0).
glm::dvec4 lightPoint(const ShadowLight& light, const glm::dvec3& centreWorld);

/// Points of a light of ShadowSettings::lightRadius, which all shine alike: as many as lightSamples says,
/// or for radius 0 the one of lightPoint(). The same ones at every call, on every machine.
///
/// - Directional: the directions to a disc across the light; the radius is the tangent of half the angle
///   under which it is seen. A sun's is 0.00465.
/// - Spot: a disc across the cone's axis, in world units.
/// - Point: a ball that from all sides looks like an even disc of that radius. Its density is that of
///   the disc's inverse Abel transform, 1 / sqrt(1 - r^2).
///
/// Discs are filled by Vogel's spiral (1979), spheres of the ball by its lift to the sphere.
std::vector<glm::dvec4> lightSamples(const ShadowLight& light, const glm::dvec3& centreWorld);

} // namespace gnomon

#endif
