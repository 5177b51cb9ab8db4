#pragma once

#include "plugin/plan/FrameWishes.h"
#include "plugin/plan/LightPlans.h"
#include "plugin/plan/Route.h"
#include "plugin/plan/Scene.h"

#include <string>
#include <vector>

namespace gnomon
{

/// How a frame's visibility reaches its picture.
struct PicturePlan
{
  RouteChoice route;
  bool isAsTold = true; ///< false if a route is asked for that cannot be taken
  ///@{
  /// The points in no layer that show shadows.
  bool shadesTranslucent = false; ///< of translucent surfaces
  bool shadesVolumes = false;     ///< samples of volumes
  ///@}
  std::vector<std::string> notes; ///< FrameReport::notes

  bool shadesPoints() const { return this->shadesTranslucent || this->shadesVolumes; }
};

/// Return the first reason against the deferred route that needs no walk over the props, as a
/// clause; empty if the props decide.
std::string whyNotDeferred(
  const std::vector<LightPlan>& lights, const FrameWishes& wishes, const Scene& scene);

/// Return why lights that leave their technique to the pass cannot have maps in VTK's shaders, as a
/// clause; empty if they can.
std::string whyNoInlineMaps(
  const std::vector<LightPlan>& lights, const FrameWishes& wishes, const Scene& scene);

/// @param lights that cast, with their techniques in this frame
/// @param scene with DeferredFacts, if whyNotDeferred() is empty
PicturePlan planPicture(
  const std::vector<LightPlan>& lights, const FrameWishes& wishes, const Scene& scene);

} // namespace gnomon
