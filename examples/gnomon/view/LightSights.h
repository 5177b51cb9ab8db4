#pragma once

#include "ImageFile.h"

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

/// Colour a grey picture by the size of the texels of a light's map: blue for a quarter of a pixel
/// or less, white for one pixel, red for four or more. Pixels outside of all views stay grey.
/// @param images the picture's receivers
/// @param camera the picture's, for the snapshot's centre
Picture texelPicture(const Picture& picture, const VisibilityImages& images,
  const LightSight& sight, const SceneFrame& frame, const CameraView& camera);

} // namespace gnomon::tool
