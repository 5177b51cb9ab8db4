#ifndef gnomon_shadowtech_conservative_MeetingBoxes_h
#define gnomon_shadowtech_conservative_MeetingBoxes_h

#include "lights/Bounds.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

/// Visits the pairs of boxes that have a point in common, by Embree. Their borders are rounded to float: boxes that miss each
/// other by less may be visited, and such as only just touch may be missed.
/// @param visit called once with each pair, the lesser number first; may be from several threads
/// @throws std::runtime_error where Embree fails
void visitMeetingBoxes(
  const std::vector<Bounds>& boxes, const std::function<void(std::uint32_t, std::uint32_t)>& visit);

} // namespace gnomon

#endif
