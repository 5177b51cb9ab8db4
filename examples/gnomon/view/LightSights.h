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

/// A light that casts, as its technique takes it, and what its map shows.
struct LightSight
{
  ShadowLight light;
  LightViews views; ///< none of a technique without a map
};

/// What a renderer's lights see: the same snapshot and views that the pass makes, for overlays.
///
/// Views that are fitted to receivers (the setting `fit`) are those of the camera's frustum here,
/// which hold them: the last fit is made on the GPU and not read back.
class LightSights
{
public:
  /// @param settings what the pass has lights do that say nothing themselves
  void update(vtkRenderer* renderer, const ShadowSettings& settings);

  const std::vector<LightSight>& lights() const { return this->lights_; }
  /// The light of that number in the renderer's collection; null if it does not cast.
  const LightSight* find(int sceneIndex) const;
  const OccluderCollector& snapshot() const { return this->collector_; }

private:
  OccluderCollector collector_;
  std::vector<LightSight> lights_;
};

/// The edges of what the views of a light's map hold, in world coordinates, a colour for each view.
vtkSmartPointer<vtkPolyData> frustumLines(const LightViews& views, const glm::dvec3& centreWorld);

/// The side of a texel at a point that a light's map shows, across the light.
/// @param positionCentred of the point
/// @param sizeTexels of the map
/// @return 0 where no view holds the point
double texelSide(const LightViews& views, int sizeTexels, const glm::dvec3& positionCentred);

/// The colour of the view of that number.
glm::dvec3 colourOfView(std::size_t view);

} // namespace gnomon::tool
