#pragma once

#include "plugin/frame/CastingLights.h"
#include "plugin/frame/ViewValues.h"
#include "plugin/scene/SurfaceNames.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"

#include <vector>

namespace gnomon
{

/// A frame's visibility and what it is of, as data for people: a copy, top row first.
/// @param values of each light in turn, classified
/// @param view whose receivers' images are on the CPU
/// @param receivers of the view
/// @param names of the snapshot's surfaces
VisibilityImages keepVisibility(const CastingLights& lights, const ViewValues& view,
  const ReceiverPixels& receivers, const Occluders& occluders,
  const std::vector<SurfaceName>& names);

} // namespace gnomon
