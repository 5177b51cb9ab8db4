#pragma once

#include "lights/vtkGnomonVersions.h"
#include "plugin/plan/FrameWishes.h"
#include "plugin/plan/Scene.h"
#include "shadowtech/base/Technique.h"

#include <map>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// True if OpenGL is new enough (4.3) for techniques that work on the GPU. Needs a current context.
bool canDrawMaps();

/// Reads the lights of a renderer.
class LightReading
{
public:
  /// @param defaults settings for lights without their own
  SceneLights read(
    vtkRenderer* renderer, const ShadowSettings& defaults, const FrameWishes& wishes);

private:
  MapTraits traitsOf(const EstimatorEntry& estimator, const ShadowLight& light);

  LightManager manager_;
  std::map<const EstimatorEntry*, AnyTechnique> techniques_; ///< that are asked for traits alone
};

/// Return what a plan must know of the snapshot.
SceneProps readProps(const Occluders& occluders);

} // namespace gnomon
