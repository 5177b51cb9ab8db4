#pragma once

#include "plugin/ranks/Ranks.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Patches.h"
#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon
{

/// Leave out of this rank's image what other ranks hide; collective.
/// @param windowDepths of what the rank drew, 1 where it drew nothing
/// @param fragments ReceiverImages::fragments
/// @throws RankFailure
void keepNearest(
  Ranks& ranks, const std::vector<float>& windowDepths, std::vector<glm::vec2>& fragments);

/// The receivers of a picture that several ranks draw. A pixel's receiver is on the nearest surface
/// of all ranks. The rank that drew it computes the receiver once, and all ranks hold the same bits
/// of all receivers, so that each can trace them against its own casters.
class SharedReceivers
{
public:
  /// Share what this rank drew; collective.
  /// @param own receivers on the rank's own triangles, where no other rank hides them
  /// @param snapshot of the rank
  /// @throws RankFailure
  void share(Ranks& ranks, const ReceiverPixels& own, const Occluders& snapshot);
  /// Share the curves above receivers, after these; collective.
  /// @param own as before
  /// @param names of the snapshot's patches
  /// @throws RankFailure
  void shareCurves(
    Ranks& ranks, const ReceiverPixels& own, const Occluders& snapshot, const PatchNames& names);
  /// Share which surface each pixel shows; collective. Not again before clear().
  /// @param fragments as keepNearest() left them; set to 0 where another rank's receiver was taken
  /// @param numbers by drawn surface, a number that is the same on all ranks, from 0
  /// @throws RankFailure
  void shareSurfaces(
    Ranks& ranks, std::vector<glm::vec2>& fragments, const std::vector<std::size_t>& numbers);
  /// Forget the receivers, but keep their memory: new memory takes longer than they do.
  void clear()
  {
    this->receivers_.reset();
    this->surfaceOfPixel_.clear();
  }
  /// True if there are receivers. What follows is valid then.
  bool areShared() const { return this->receivers_.has_value(); }

  /// Return the whole picture's receivers. Their surface is 0: receivers() are used with
  /// surfaces(), not with the rank's snapshot. Surfaces that do not receive count as not covered.
  const ReceiverPixels& pixels() const { return this->pixels_; }
  Receivers& receivers() { return *this->receivers_; }
  /// Return a snapshot of one surface that receives and has no triangles, with the ranks' common
  /// centre.
  const Occluders& surfaces() const { return this->surfaces_; }

  /// Return x: a number of the surface that a pixel shows, negative; 0: none. Empty until
  /// shareSurfaces().
  const std::vector<glm::vec2>& surfaceOfPixel() const { return this->surfaceOfPixel_; }
  /// Return how many of the receivers are this rank's, and which.
  std::size_t ownCount() const { return this->ownCount_; }
  bool isOwn(std::size_t pixel) const { return this->isOwn_[pixel]; }
  /// Return in how many pixels several ranks drew different receivers at the same depth.
  std::size_t ties() const { return this->ties_; }
  /// Return the bytes of memory in use.
  std::size_t bytes() const;

private:
  /// A receiver on its way.
  struct PackedReceiver
  {
    float numbers[7]; ///< in the order of ReceiverPixels::planes
  };

  /// A curve on its way.
  struct PlacedCurve
  {
    std::uint32_t pixel;
    ReceiverPixels::Curve curve;
  };

  void insert(bool isOwn, const std::uint64_t* claims, const PackedReceiver* next);
  PackedReceiver at(std::size_t pixel) const;

  ReceiverPixels pixels_;
  std::optional<Receivers> receivers_; ///< made with pixels_
  Occluders surfaces_;
  std::vector<std::uint64_t> claims_; ///< this rank's: a bit for each pixel that has one of packed_
  std::vector<PackedReceiver> packed_; ///< in the order of their pixels
  Ranks::Gathered<std::uint64_t> allClaims_;
  Ranks::Gathered<PackedReceiver> all_;
  Ranks::Gathered<PlacedCurve> allCurves_;
  std::size_t ownCount_ = 0;
  std::vector<bool> isOwn_; ///< by pixel
  std::size_t ties_ = 0;
  std::vector<glm::vec2> surfaceOfPixel_;
};

} // namespace gnomon
