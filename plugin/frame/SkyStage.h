#pragma once

#include "plugin/frame/Frame.h"
#include "plugin/frame/SnapshotTracer.h"

#include <cstddef>
#include <vector>

namespace gnomon
{

/// The sky stage of a renderer's frames: the view that each pixel's receiver has of the sky, in a
/// layer of the view's images.
class SkyStage
{
public:
  SkyStage(Frame& frame, SnapshotTracer& tracer)
    : frame_(frame)
    , tracer_(tracer)
  {
  }

  /// Trace what the view lacks. The receivers and the layers are there.
  /// @throws std::runtime_error if there is no tracer
  void compute();

private:
  void showAll(const SkyPlan& plan, SkyValue& value);
  void trace(const SkyPlan& plan, SkyImage& image);

  Frame& frame_;
  SnapshotTracer& tracer_;
  std::vector<float> view_; ///< kept, as new memory costs more than old
};

} // namespace gnomon
