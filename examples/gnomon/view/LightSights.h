#pragma once

#include "lights/LightViews.h"
#include "lights/ShadowLight.h"
#include "plugin/scene/OccluderCollector.h"

#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace gnomon::tool
{

/// A casting light as its technique sees it, and the views of its map.
struct LightSight
{
  ShadowLight light;
  LightViews views; ///< none of a technique without a map
};

/// The views of a renderer's lights for overlays, from the same snapshot as the pass.
///
/// A view that the pass fits to receivers (the setting `fit`) is fitted to the camera's frustum
/// here, which contains it: the pass fits on the GPU and does not read the fit back.
class LightSights
{
public:
  /// @param settings the pass's, for settings that a light lacks
  void update(vtkRenderer* renderer, const ShadowSettings& settings);

  const std::vector<LightSight>& lights() const { return this->lights_; }
  /// Return the light of that number in the renderer's collection; null if it does not cast.
  const LightSight* find(int sceneIndex) const;
  const OccluderCollector& snapshot() const { return this->collector_; }

private:
  OccluderCollector collector_;
  std::vector<LightSight> lights_;
};

/// Return the edges of the view volumes of a light's map, in world coordinates, in a colour for
/// each view.
vtkSmartPointer<vtkPolyData> frustumLines(const LightViews& views, const SceneFrame& frame);

/// Return a texel's side at a point, across the light, in world units.
/// @param positionCentred of the point
/// @param sizeTexels of the map
/// @return 0 if no view contains the point
double texelSide(const LightViews& views, int sizeTexels, const glm::dvec3& positionCentred);

/// Return a view's colour by its number.
glm::dvec3 colourOfView(std::size_t view);

} // namespace gnomon::tool
