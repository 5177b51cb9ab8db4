#pragma once

#include "plugin/ranks/Ranks.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon
{

/// The receivers of a picture that several ranks draw: in each pixel that of the rank that drew the
/// nearest surface. The rank computes it once, and all ranks hold all of them, bit for bit the
/// same, so that each can trace them against its own casters.
class SharedReceivers
{
public:
  /// Share what this rank drew; collective.
  /// @param own receivers of the rank's own surfaces, on their triangles
  /// @param snapshot of the rank
  /// @param windowDepths of what the rank drew, 1 where it drew nothing
  /// @throws RankFailure
  SharedReceivers(Ranks& ranks, const ReceiverPixels& own, const Occluders& snapshot,
    std::vector<float> windowDepths);
  SharedReceivers(const SharedReceivers&) = delete;
  SharedReceivers& operator=(const SharedReceivers&) = delete;

  /// Return the whole picture's receivers. Their surface is 0: receivers() are used with
  /// surfaces(), not with the rank's snapshot. Surfaces that do not receive count as not covered.
  const ReceiverPixels& pixels() const { return this->pixels_; }
  Receivers& receivers() { return *this->receivers_; }
  /// Return a snapshot of one surface that receives and has no triangles, with the ranks' common
  /// centre.
  const Occluders& surfaces() const { return this->surfaces_; }

  /// Return how many of the receivers are this rank's.
  std::size_t own() const { return this->own_; }
  /// Return in how many pixels several ranks drew different receivers at the same depth.
  std::size_t ties() const { return this->ties_; }
  std::size_t bytes() const { return this->pixels_.bytes(); }

private:
  /// A receiver on its way.
  struct Sent
  {
    float numbers[7]; ///< in the order of ReceiverPixels::planes
  };

  ReceiverPixels pixels_;
  std::optional<Receivers> receivers_; ///< made with pixels_
  Occluders surfaces_;
  std::size_t own_ = 0;
  std::size_t ties_ = 0;
};

} // namespace gnomon
