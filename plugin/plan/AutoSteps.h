#pragma once

#include "shadowtech/probing/ProbeCounts.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace gnomon
{

/// Samples of area lights in motion, tried in turn; then 16, 32, 64... Up to 16 a frame takes at
/// most 1.25 times as long as with the number before (soft-window: 24 to 52 ms).
inline constexpr std::array<int, 5> fewSamples = { 4, 6, 8, 10, 12 };

/// Return the samples of an area light at a step of its choice, from the second step on.
inline int samplesOf(int step)
{
  const auto next = static_cast<std::size_t>(step - 1);
  return next < fewSamples.size() ? fewSamples[next] : 16 << (next - fewSamples.size());
}

/// Return by how many steps a map's side is to be halved, as its probes say: wrong pixels lie along
/// edges, and their number is in proportion to the texels' width. As many probes as there may be
/// are to prove the smaller map if they go on like these, with twice as many wrong, to be safe.
/// @param looks the most sets of pixels that prove a map; `probes` are those of one set
inline int spareSteps(const WrongProbes& probes, std::size_t looks, int step, double limit)
{
  WrongProbes expected{ looks * probes.asked, 2 * looks * probes.wrong };
  int spare = 0;
  for (; spare < step; ++spare)
  {
    expected.wrong = std::min(2 * expected.wrong, expected.asked);
    if (expected.mostShare() > limit)
    {
      break;
    }
  }
  return spare;
}

} // namespace gnomon
