#include "shadowtech/base/ReceiverBoxes.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace gnomon
{
namespace
{

/// Return the boxes around groups of 2 x 2 boxes.
ReceiverBoxes::Level groupsOf(const ReceiverBoxes::Level& level)
{
  ReceiverBoxes::Level groups{ tilesAcross(level.columns, 2), tilesAcross(level.rows, 2), {} };
  groups.boxesCentred.resize(groups.columns * groups.rows);
  for (std::size_t i = 0; i < level.boxesCentred.size(); ++i)
  {
    const std::size_t group = i / level.columns / 2 * groups.columns + i % level.columns / 2;
    groups.boxesCentred[group].add(level.boxesCentred[i]);
  }
  return groups;
}

} // namespace

Bounds boxOf(
  const ReceiverPixels& receivers, std::size_t first, std::size_t columns, std::size_t rows)
{
  constexpr float most = std::numeric_limits<float>::max();
  glm::vec3 lower(most);
  glm::vec3 upper(-most);
  float offset = 0.0f;
  for (std::size_t row = 0; row < rows; ++row)
  {
    const std::size_t from = first + row * static_cast<std::size_t>(receivers.width);
    for (std::size_t i = from; i < from + columns; ++i)
    {
      if (receivers.surface[i] != ReceiverPixels::notCovered)
      {
        const glm::vec3 position = receivers.position(i);
        lower = glm::min(lower, position);
        upper = glm::max(upper, position);
        const float height = receivers.curved[i] != 0 ? receivers.curves[i].height : 0.0f;
        offset = std::max(offset, receivers.offset[i] + height);
      }
    }
  }
  return lower.x > upper.x
    ? Bounds()
    : inflated({ glm::dvec3(lower), glm::dvec3(upper) }, static_cast<double>(offset));
}

ReceiverBoxes::ReceiverBoxes(const ReceiverPixels& receivers, const Occluders& occluders)
  : width_(static_cast<std::size_t>(receivers.width))
  , height_(static_cast<std::size_t>(receivers.height))
  , receives_(receivers.size())
{
  std::vector<std::uint8_t> ofSurfaces(occluders.surfaces.size() + 1);
  std::transform(occluders.surfaces.begin(), occluders.surfaces.end(), ofSurfaces.begin() + 1,
    [](const Surface& surface) { return surface.receives ? 1 : 0; });
  Level cells{ tilesAcross(this->width_, cellColumns), tilesAcross(this->height_, cellRows), {} };
  cells.boxesCentred.resize(cells.columns * cells.rows);
  tbb::parallel_for(std::size_t(0), cells.rows,
    [&](std::size_t row)
    {
      const std::size_t firstRow = row * cellRows;
      const std::size_t rows = std::min(cellRows, this->height_ - firstRow);
      for (std::size_t column = 0; column < cells.columns; ++column)
      {
        const std::size_t firstColumn = column * cellColumns;
        cells.boxesCentred[row * cells.columns + column] =
          boxOf(receivers, firstRow * this->width_ + firstColumn,
            std::min(cellColumns, this->width_ - firstColumn), rows);
      }
      // notCovered + 1 is 0
      std::transform(&receivers.surface[firstRow * this->width_],
        receivers.surface.data() + (firstRow + rows) * this->width_,
        &this->receives_[firstRow * this->width_],
        [&](std::uint32_t surface) { return ofSurfaces[surface + 1u]; });
    });
  this->levels_.push_back(std::move(cells));
  while (this->levels_.size() <= levelOfTiles || this->levels_.back().boxesCentred.size() > 1)
  {
    this->levels_.push_back(groupsOf(this->levels_.back()));
  }
}

std::size_t ReceiverBoxes::bytes() const
{
  return bytesOf(this->receives_) +
    bytesOfAll(this->levels_, [](const Level& level) { return bytesOf(level.boxesCentred); });
}

} // namespace gnomon
