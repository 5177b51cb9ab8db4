#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/ReceiverBoxes.h"
#include "shadowtech/tracing/CasterHits.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct LightCounts;
struct Occluders;

/// A light's visibility in whole parts of the picture, as far as it is known without rays:
///
/// - Unreached: nothing visible there lies in the light's cone or box;
/// - Lit: no casting surface's box lies between the receivers there and the light;
/// - Shadow: one blocker hides the light from all receivers there (UmbraProof).
///
/// Tracing finds the same, bit for bit. Whole pictures are tested first, then quarters of what is
/// undecided, down to cells. Lights without texture only.
class TileVerdicts
{
public:
  /// @param boxes of the picture; they must outlive this object
  /// @param hits of the same snapshot
  TileVerdicts(const ShadowLight& light, const Occluders& occluders, const ReceiverBoxes& boxes,
    const CasterHits& hits);

  /// Set what is known of a tile's receivers: Lit for those that face the light, Shadow or
  /// Unreached. Leaves all others as they are.
  /// @param certain by pixel of the tile
  void ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const;
  /// Return, by tile, row by row, 1 if all of its receivers are dark.
  const std::vector<std::uint8_t>& darkTiles() const { return this->darkTiles_; }
  bool areAllDark() const;
  /// True if more than an eighth of the cells need rays.
  bool needManyRays() const;

  ///@{
  /// Fill a dark tile's visibility, or each pixel's TracedClass, as tracing would. The class is
  /// Shadow also for receivers in shadow that face away from the light.
  /// @param lit the visibility of pixels that show no receiver
  void fillDark(std::size_t tile, float lit, std::vector<float>& visibility) const;
  void classifyDark(std::size_t tile, std::vector<std::uint8_t>& classes) const;
  void classifyAllDark(std::vector<std::uint8_t>& classes) const;
  ///@}

  /// Report the counts of tiles, and the reason if no ray was needed.
  /// @return the share of tiles that have rays
  double tell(const ShadowLight& light, LightCounts& counts) const;

private:
  Certainty ofPixel(std::size_t column, std::size_t row) const
  {
    return this->cells_[row / ReceiverBoxes::cellRows * this->boxes_.levels()[0].columns +
      column / ReceiverBoxes::cellColumns];
  }
  std::size_t tileOf(std::size_t cell) const;
  template <typename Visit>
  void visitRows(std::size_t tile, const Visit& visit) const;
  void decide(const ShadowLight& light, const Occluders& occluders, const CasterHits& hits);

  const ReceiverBoxes& boxes_;
  std::vector<Certainty> cells_;
  std::vector<std::uint8_t> darkTiles_;
};

} // namespace gnomon
