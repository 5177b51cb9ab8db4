#pragma once

#include "FrameVariant.h"

#include <functional>
#include <vector>

namespace gnomon::tool
{

/// Frames that are drawn and not counted when the motion changes.
inline constexpr int warmUpFrames = 3;

/// The middle value, the upper one of two; 0 of nothing.
double median(std::vector<double> values);

/// The median wall clock time of a frame of each variant, in milliseconds. Variants take turns
/// frame by frame, so that what else the machine does touches all alike.
/// @param frames that count; warmUpFrames more are drawn first
/// @param roundDone is called after every round of one frame each
std::vector<double> timeFrames(const std::vector<FrameVariant*>& variants, Motion motion,
  int frames, const std::function<void()>& roundDone);

} // namespace gnomon::tool
