#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/Receivers.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Return the box around the receivers of a part of a picture and the starts of their shadow rays,
/// to within the rounding of float. Centred; empty if the part shows no receiver.
/// @param first the part's first pixel
Bounds boxOf(
  const ReceiverPixels& receivers, std::size_t first, std::size_t columns, std::size_t rows);

/// Boxes around the receivers of a picture, built once for all lights. The lowest level has boxes
/// of cells of some pixels; each level above groups 2 x 2 boxes, up to the whole picture.
class ReceiverBoxes
{
public:
  ///@{
  /// A cell's size in pixels; a tile is 2 x 2 cells. Testing smaller cells takes longer than
  /// tracing them.
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
  /// Return the levels, cells first, the whole picture last. There is always a level of tiles.
  const std::vector<Level>& levels() const { return this->levels_; }
  /// Return, by pixel, 1 if it shows a surface that receives, else 0.
  const std::vector<std::uint8_t>& receives() const { return this->receives_; }
  std::size_t bytes() const;

private:
  std::size_t width_, height_;
  std::vector<Level> levels_;
  std::vector<std::uint8_t> receives_;
};

} // namespace gnomon
