#pragma once

#include "lights/ShadowLight.h"
#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <vtkNew.h>

#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkLightCollection;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// A point that an area light shines from.
struct ShiningPoint
{
  glm::dvec3 offset{ 0.0 }; ///< from the centre, as LightArea measures it
  glm::dvec3 shine{
    1.0
  }; ///< its colour by the light's own; on the mean over all points, the mean of the light's texture
};

/// An area light, and the points that stand for it.
struct PointedLight
{
  ShadowLight light;
  ShiningPoint centre; ///< that all of its light comes from where it is a single point
  std::vector<ShiningPoint> points;
};

/// The light with pairedLightSamples(). Of a channel that the texture has and none of the points,
/// they have nothing.
PointedLight pointedLight(ShadowLight light);

/// For as long as this lives, a renderer has lights without areas in place of its area lights, in
/// the same order. They stand at the centres, until they move over their areas together. Then the
/// renderer has its own lights again, unchanged.
///
/// Each is as its area light is, but for where it shines from, and with what colour where the light
/// has a texture. A spot's cone moves along with its point. A directional light turns about its
/// position, and with it its box: about the middle of the near face.
class PointLights
{
public:
  PointLights(vtkRenderer* renderer, const std::vector<PointedLight>& areas);
  ~PointLights();
  PointLights(const PointLights&) = delete;
  PointLights& operator=(const PointLights&) = delete;

  /// Moves every light to its point of this number.
  void moveTo(std::size_t point);

private:
  vtkRenderer* renderer_;
  vtkLightCollection* own_;
  vtkNew<vtkLightCollection> standIns_;
  const std::vector<PointedLight>& areas_;
};

} // namespace gnomon
