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

/// A point from which an area light shines.
struct ShiningPoint
{
  glm::dvec3 offset{ 0.0 }; ///< from the centre, as LightArea measures it
  glm::dvec3 shine{
    1.0
  }; ///< its colour relative to the light's; the mean over all points is that of the light's
     ///< texture
};

/// An area light, and the points that replace it.
struct PointedLight
{
  ShadowLight light;
  ShiningPoint centre; ///< replaces the light by a single point
  std::vector<ShiningPoint> points;
};

/// Return the light with pairedLightSamples(). A channel that the texture has but none of the
/// points is black.
PointedLight pointedLight(ShadowLight light);

/// While this lives, lights without areas replace a renderer's area lights, in the same order. They
/// are at the centres until moveTo() moves them over their areas together. The destructor restores
/// the renderer's own lights, unchanged.
///
/// Each equals its area light except for its position and, if the light has a texture, its colour.
/// A spot's cone moves along with its point. A directional light, and its box, turn about its
/// position, the middle of the near face.
class PointLights
{
public:
  PointLights(vtkRenderer* renderer, const std::vector<PointedLight>& areas);
  ~PointLights();
  PointLights(const PointLights&) = delete;
  PointLights& operator=(const PointLights&) = delete;

  /// Move every light to its point of this index.
  void moveTo(std::size_t point);

private:
  vtkRenderer* renderer_;
  vtkLightCollection* own_;
  vtkNew<vtkLightCollection> standIns_;
  const std::vector<PointedLight>& areas_;
};

} // namespace gnomon
