#pragma once

#include "plugin/frame/CastingLights.h"
#include "plugin/frame/ViewValues.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/VisibilityLayers.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// A frame's visibility and what it is of, as data for people: a copy, top row first.
/// @param values of each light in turn, classified
/// @param centreWorld Occluders::centreWorld
VisibilityImages keepVisibility(const CastingLights& lights,
  const std::vector<VisibilityValue>& values, const VisibilityLayers& layers,
  const ReceiverPixels& receivers, const glm::dvec3& centreWorld);

} // namespace gnomon
