#ifndef gnomon_lights_MapAliasing_h
#define gnomon_lights_MapAliasing_h

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <optional>

namespace gnomon
{

/// A point of a surface, in centred coordinates.
struct SurfacePoint
{
  glm::dvec3 positionCentred;
  glm::dvec3 normalCentred; ///< of any length but 0
};

/// The sides of a map's texel on a surface, in pixels of the camera's picture: the aliasing measure
/// of both axes of the map (Apelles, eqs 3.17 and 3.18; Lloyd 2007, section 3.2). Above 1 the texel
/// can be seen.
///
/// @param mapFromAcross the projection with its fit
/// @return nothing where the measure has no meaning: the surface is edge-on to the light, or the
/// point is not before the camera and in the light's view
std::optional<glm::dvec2> texelPixels(const SurfacePoint& point, const CameraView& camera,
  const glm::dvec2& viewportPixels, const LightRays& rays, const glm::dmat3& mapFromAcross,
  int mapSizeTexels);

} // namespace gnomon

#endif
