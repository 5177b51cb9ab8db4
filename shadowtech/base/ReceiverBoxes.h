#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/Receivers.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The box around what a part of some receivers' picture shows, and the starts of its shadow rays,
/// to within the rounding of float. Centred; empty if nothing is covered there.
/// @param first the part's first pixel
Bounds boxOf(
  const ReceiverPixels& receivers, std::size_t first, std::size_t columns, std::size_t rows);

/// Boxes around the receivers of a picture, made once for all lights: of cells of some pixels, and
/// of groups of 2 x 2 boxes of the level below, up to the whole picture.
class ReceiverBoxes
{
public:
  ///@{
  /// A cell's pixels; tiles are groups of 2 x 2 cells. Smaller cells take longer to ask about than
  /// to trace.
  static constexpr std::size_t cellColumns = ReceiverTile::mostColumns / 2;
  static constexpr std::size_t cellRows = ReceiverTile::mostRows / 2;
  static constexpr std::size_t levelOfTiles = 1;
  ///@}

  /// Boxes side by side, row by row from the bottom.
  struct Level
  {
    std::size_t columns, rows;
    std::vector<Bounds> boxesCentred;
  };

  /// @param receivers of the whole picture
  ReceiverBoxes(const ReceiverPixels& receivers, const Occluders& occluders);

  std::size_t width() const { return this->width_; }
  std::size_t height() const { return this->height_; }
  /// Cells first, the whole picture last; no fewer than those up to the tiles.
  const std::vector<Level>& levels() const { return this->levels_; }
  /// By pixel: 1 if it shows a surface that receives, else 0.
  const std::vector<std::uint8_t>& receives() const { return this->receives_; }
  std::size_t bytes() const;

private:
  std::size_t width_, height_;
  std::vector<Level> levels_;
  std::vector<std::uint8_t> receives_;
};

} // namespace gnomon
