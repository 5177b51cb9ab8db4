#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/ReceiverBoxes.h"
#include "shadowtech/tracing/CasterHits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

struct LightReport;
struct Occluders;

/// What is known of a light's visibility in whole parts of the picture, so that these need no rays:
///
/// - Unreached: the light's cone or box holds nothing that is seen there;
/// - Lit: no casting surface's box is between what is seen there and the light;
/// - Shadow: one blocker hides the light from all that is seen there (UmbraProof).
///
/// Tracing finds the same, bit for bit. Whole pictures are asked about first, then quarters of what
/// is not known, down to cells. Lights without texture only.
class TileVerdicts
{
public:
  /// @param boxes of the picture; they live as long as this
  /// @param hits of the same snapshot
  TileVerdicts(const ShadowLight& light, const Occluders& occluders, const ReceiverBoxes& boxes,
    const CasterHits& hits);

  /// Says what is known of a tile's receivers: Lit of those that face the light, Shadow or
  /// Unreached. Leaves all others as they are.
  /// @param certain by pixel of the tile
  void ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const;
  /// By tile, row by row: 1 if all of its receivers are dark.
  const std::vector<std::uint8_t>& darkTiles() const { return this->darkTiles_; }
  bool areAllDark() const;
  /// Whether rays are needed in more than an eighth of the cells.
  bool needManyRays() const;

  ///@{
  /// Fills what tracing a dark tile would: the visibility, and each pixel's TracedClass. That is
  /// Shadow for receivers in shadow that are turned away from the light, too.
  /// @param lit the visibility of pixels that show no receiver
  void fillDark(std::size_t tile, float lit, std::vector<float>& visibility) const;
  void classifyDark(std::size_t tile, std::vector<std::uint8_t>& classes) const;
  void classifyAllDark(std::vector<std::uint8_t>& classes) const;
  ///@}

  /// Counts tiles, and says why no ray was needed if so.
  void tell(const ShadowLight& light, LightReport& report) const;

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
