#pragma once

#include "plugin/frame/Frame.h"
#include "plugin/scene/OccluderCollector.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <cstddef>

namespace gnomon
{

/// A finished frame's facts, beside its plan and counts.
struct FrameTotals
{
  bool numbersByGeometryShaders = false; ///< as in FrameReport, like all that follows
  std::size_t bytesOccluders = 0, bytesBvh = 0, bytesMaps = 0, bytesImages = 0;
  double wallMilliseconds = 0.0;
};

/// Report a frame. No stage reads reports.
FrameReport reportOf(
  const Frame& frame, const OccluderCollector& collector, const FrameTotals& totals);

} // namespace gnomon
