#include "shadowtech/tracing/TracedTiles.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/ReceiverBoxes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace gnomon
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// More boxes of moved surfaces than these would cost more time than they save.
constexpr std::size_t mostBoxes = 32;

Bounds everything()
{
  return { glm::dvec3(-infinity), glm::dvec3(infinity) };
}

bool haveCommonPoint(const Bounds& a, const Bounds& b)
{
  return glm::all(glm::lessThanEqual(a.lower, b.upper)) &&
    glm::all(glm::lessThanEqual(b.lower, a.upper));
}

/// Reduce [first, last] to the part where a + b t <= 0.
void clip(double a, double b, double& first, double& last)
{
  if (b > 0.0)
  {
    last = std::min(last, -a / b);
  }
  else if (b < 0.0)
  {
    first = std::max(first, -a / b);
  }
  else if (a > 0.0)
  {
    last = -infinity;
  }
}

/// True if two pictures show the same triangles in a tile.
bool showSame(const ReceiverImages& images, const std::vector<glm::vec2>& before,
  std::size_t firstColumn, std::size_t firstRow)
{
  const auto width = static_cast<std::size_t>(images.width);
  const auto height = static_cast<std::size_t>(images.height);
  const std::size_t columns = std::min(ReceiverTile::mostColumns, width - firstColumn);
  const std::size_t rows = std::min(ReceiverTile::mostRows, height - firstRow);
  for (std::size_t y = 0; y < rows; ++y)
  {
    const std::size_t first = (firstRow + y) * width + firstColumn;
    if (std::memcmp(&images.fragments[first], &before[first], columns * sizeof(glm::vec2)) != 0)
    {
      return false;
    }
  }
  return true;
}

} // namespace

SweptBox::SweptBox(const Bounds& from, const ShadowLight& light, const glm::dvec3& centreWorld)
  : from_(from)
{
  glm::dvec3 half(0.0);
  if (light.area)
  {
    const glm::dmat3& axes = light.area->worldFromUnit;
    half = glm::abs(axes[0]) + glm::abs(axes[1]) + glm::abs(axes[2]);
  }
  if (light.kind == LightKind::Directional)
  {
    const glm::dvec3 toLight = -glm::normalize(light.directionWorld);
    this->lower_ = toLight - half;
    this->upper_ = toLight + half;
    this->last_ = infinity;
  }
  else
  {
    const glm::dvec3 position = light.positionWorld - centreWorld;
    this->lower_ = position - half - from.lower;
    this->upper_ = position + half - from.upper;
    this->last_ = 1.0;
  }
}

bool SweptBox::meets(const Bounds& centred) const
{
  double first = 0.0;
  double last = this->last_;
  for (int axis = 0; axis < 3; ++axis)
  {
    clip(this->from_.lower[axis] - centred.upper[axis], this->lower_[axis], first, last);
    clip(centred.lower[axis] - this->from_.upper[axis], -this->upper_[axis], first, last);
  }
  return first <= last;
}

void TracedTiles::forget()
{
  *this = TracedTiles();
}

/// Return the old and new boxes of surfaces that moved since the last image.
std::vector<Bounds> TracedTiles::movedSince(const Occluders& occluders) const
{
  std::vector<Bounds> moved;
  Bounds all = occluders.allCentred;
  for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    const Surface& surface = occluders.surfaces[i];
    if (surface.positionsVersion == this->places_[i].positionsVersion)
    {
      continue;
    }
    for (const Bounds& place : { this->places_[i].centred, surface.boundsCentred })
    {
      if (!place.empty())
      {
        moved.push_back(place);
        all.add(place);
      }
    }
  }
  const double more = floatNoise * largestCoordinate(all);
  if (moved.size() > mostBoxes)
  {
    Bounds together;
    for (const Bounds& place : moved)
    {
      together.add(place);
    }
    moved = { together };
  }
  for (Bounds& place : moved)
  {
    place = inflated(place, more);
  }
  return moved;
}

void TracedTiles::begin(const Occluders& occluders, const ShadowLight& light,
  const ReceiverImages& images, const std::vector<glm::vec2>* before)
{
  const std::size_t columns =
    tilesAcross(static_cast<std::size_t>(images.width), ReceiverTile::mostColumns);
  const std::size_t tiles =
    columns * tilesAcross(static_cast<std::size_t>(images.height), ReceiverTile::mostRows);
  const bool isLike = before && before->size() == images.fragments.size() &&
    this->boxes_.size() == tiles && this->tilesAcross_ == columns &&
    this->lightSamples_ == light.lightSamples &&
    this->topologyVersion_ == occluders.topologyVersion &&
    this->centreWorld_ == occluders.frame.centre;
  this->kept_.assign(tiles, 0);
  this->boxes_.resize(tiles, everything());
  if (isLike)
  {
    const std::vector<Bounds> moved = this->movedSince(occluders);
    tbb::parallel_for(std::size_t(0), tiles,
      [&](std::size_t tile)
      {
        const Bounds& box = this->boxes_[tile];
        bool isKept = showSame(images, *before, tile % columns * ReceiverTile::mostColumns,
          tile / columns * ReceiverTile::mostRows);
        if (isKept && !box.empty())
        {
          const SweptBox swept(box, light, occluders.frame.centre);
          isKept = std::none_of(moved.begin(), moved.end(),
            [&](const Bounds& surface)
            { return haveCommonPoint(box, surface) || swept.meets(surface); });
        }
        this->kept_[tile] = isKept ? 1 : 0;
      });
  }
  for (std::size_t tile = 0; tile < tiles; ++tile)
  {
    if (this->kept_[tile] == 0)
    {
      this->boxes_[tile] = everything();
    }
  }
  this->tilesAcross_ = columns;
  this->lightSamples_ = light.lightSamples;
  this->topologyVersion_ = occluders.topologyVersion;
  this->centreWorld_ = occluders.frame.centre;
  this->places_.clear();
  for (const Surface& surface : occluders.surfaces)
  {
    this->places_.push_back({ surface.positionsVersion, surface.boundsCentred });
  }
}

void TracedTiles::note(const ReceiverTile& tile)
{
  this->boxes_[tile.number(this->tilesAcross_)] =
    boxOf(tile.receivers, tile.first, tile.columns, tile.rows);
}

std::size_t TracedTiles::bytes() const
{
  return bytesOf(this->places_) + bytesOf(this->boxes_) + bytesOf(this->kept_);
}

} // namespace gnomon
