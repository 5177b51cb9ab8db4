#pragma once

#include "FrameVariant.h"

#include <functional>
#include <vector>

namespace gnomon::tool
{

/// The number of frames that are rendered but not counted after a change of motion.
inline constexpr int warmUpFrames = 3;

/// Return the median: the upper of two middle values, or 0 without values.
double median(std::vector<double> values);

/// Return each variant's median wall clock time per frame, in milliseconds. Frames of all variants
/// are interleaved, so other load of the machine affects all alike.
/// @param frames number of counted frames, after warmUpFrames others
/// @param roundDone called after each round of one frame per variant
std::vector<double> timeFrames(const std::vector<FrameVariant*>& variants, Motion motion,
  int frames, const std::function<void()>& roundDone);

} // namespace gnomon::tool
