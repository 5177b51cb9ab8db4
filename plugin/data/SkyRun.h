#pragma once

#include "plugin/data/ReceiverStarts.h"
#include "shadowtech/sky/Sky.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

/// Traces rays from elements to a sky in parts, as VisibilityRun does to lights. Its results depend
/// neither on the parts nor on threads.
class SkyRun
{
public:
  /// One entry for each element; those without a surface stay as they are.
  struct Arrays
  {
    float* view;
    float* error; ///< standard error of the view
  };

  /// @param starts, tracer, arrays must outlive this
  /// @param bothSides elements see the sky on the side that sees more of it
  SkyRun(const ReceiverStarts& starts, const EmbreeTracer& tracer, const Sky& sky, int directions,
    bool bothSides, const Arrays& arrays);

  /// Continue until all is done or goOn() returns false.
  /// @param goOn called with the completed share, in [0, 1], after each part; false: stop
  /// @return true if all is done
  bool go(const std::function<bool(double)>& goOn);

  /// Return the number of rays traced so far.
  std::uint64_t rays() const;

private:
  struct Scratch;
  SkySums trace(std::size_t element, float side, Scratch& scratch) const;
  void see(std::size_t element, Scratch& scratch) const;

  const ReceiverStarts& receivers_;
  const EmbreeTracer& tracer_;
  Sky sky_;
  SkyDirections directions_;
  bool bothSides_;
  Arrays arrays_;
  std::vector<std::uint32_t> order_; ///< the elements that have a surface
  std::size_t done_ = 0;             ///< in order_
};

} // namespace gnomon
