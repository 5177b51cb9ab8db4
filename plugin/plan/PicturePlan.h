#pragma once

#include "plugin/plan/FrameWishes.h"
#include "plugin/plan/Route.h"
#include "shadowtech/base/Technique.h"

#include <string>
#include <vector>

namespace gnomon
{

/// A light of the picture, with its technique in this frame.
struct PictureLight
{
  const ShadowLight& light;
  const TechniqueInfo& info;
};

/// What is known of the window, its passes and the snapshot.
struct PictureFacts
{
  int samples = 1;           ///< of a pixel
  bool drawsMaps = true;     ///< OpenGL is new enough for techniques on the GPU
  bool drawnPlainly = true;  ///< no pass and no mode of the renderer draws props in its own way
  bool seenThrough = false;  ///< the receivers lack a prop (DrawnProps::seenThrough)
  bool translucent = false;  ///< translucent surfaces receive
  std::string whyNoDeferred; ///< why OpenGL cannot draw a deferred picture; empty if it can
};

/// What a walk over the props tells, if the lights allow the deferred route.
struct PropFacts
{
  bool ownShaders = false;       ///< a prop may have shaders that are not VTK's
  bool partsOfBothKinds = false; ///< an assembly has parts that passes cannot reach
};

/// How a frame's visibility reaches its picture.
struct PicturePlan
{
  RouteChoice route;
  bool isAsTold = true;           ///< false if a route is asked for that cannot be taken
  bool shadesTranslucent = false; ///< translucent surfaces show shadows
  std::vector<std::string> notes; ///< FrameReport::notes
};

/// Return the first reason against the deferred route that needs no walk over the props, as a
/// clause; empty if the props decide.
std::string whyNotDeferred(
  const std::vector<PictureLight>& lights, const FrameWishes& wishes, const PictureFacts& facts);

/// @param props read if whyNotDeferred() is empty
PicturePlan planPicture(const std::vector<PictureLight>& lights, const FrameWishes& wishes,
  const PictureFacts& facts, const PropFacts& props);

} // namespace gnomon
