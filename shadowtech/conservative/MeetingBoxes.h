#ifndef gnomon_shadowtech_conservative_MeetingBoxes_h
#define gnomon_shadowtech_conservative_MeetingBoxes_h

#include "lights/Bounds.h"
#include "shadowtech/tracing/EmbreeHandle.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

/// Finds boxes that meet, by Embree.
class MeetingBoxes
{
public:
  /// Visits the pairs of boxes that have a point in common. Their borders are rounded to float: boxes that miss each other by less
  /// may be visited, and such as only just touch may be missed.
  /// @param visit called once with each pair, the lesser number first; may be from several threads
  /// @throws std::runtime_error where Embree fails
  void visit(const std::vector<Bounds>& boxes,
    const std::function<void(std::uint32_t, std::uint32_t)>& visit);

private:
  EmbreeDevice device_; ///< from when it is first needed
};

} // namespace gnomon

#endif
