#include "shadowtech/tracing/TileVerdicts.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/vtkGnomonFrameCounts.h"
#include "shadowtech/tracing/TracedPicture.h"
#include "shadowtech/tracing/TracedTiles.h"
#include "shadowtech/tracing/UmbraProof.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon
{
namespace
{

/// Testing a group takes about as long as the rays of half a cell. So groups smaller than tiles are
/// tested only if one in `leastDecided` groups of the level above was decided. Larger groups are
/// tested unless the level above has at least `manyInVain` groups and none was decided.
constexpr std::size_t manyInVain = 64;
constexpr std::size_t leastDecided = 4; // one in four

/// More boxes of casting surfaces than these are replaced by one around all.
constexpr std::size_t mostBoxes = 32;

std::vector<Bounds> boxesOfCasters(const Occluders& occluders)
{
  std::vector<Bounds> boxes;
  for (const Surface& surface : occluders.surfaces)
  {
    if (surface.casts && surface.triangleCount > 0)
    {
      boxes.push_back(surface.boundsCentred);
    }
  }
  return boxes.size() > mostBoxes ? std::vector<Bounds>{ occluders.castersCentred } : boxes;
}

/// The extent of a box along a direction.
struct Extent
{
  double lower, upper;

  Extent(const Bounds& box, const glm::dvec3& direction)
    : lower(glm::dot(box.centre(), direction))
    , upper(this->lower)
  {
    const double half = glm::dot(0.5 * (box.upper - box.lower), glm::abs(direction));
    this->lower -= half;
    this->upper += half;
  }
};

/// True if a plane that touches a spot light's cone separates it from a box.
/// @param fromLight the box relative to the light
/// @param noise upper bound of rounding errors
bool isOutsideCone(const Bounds& fromLight, const ShadowRayLight& light, double noise)
{
  const glm::dvec3 axis = -glm::dvec3(light.toLight);
  const glm::dvec3 centre = fromLight.centre();
  const glm::dvec3 across = centre - glm::dot(centre, axis) * axis;
  const double length = glm::length(across);
  if (Extent(fromLight, -axis).lower > noise)
  {
    return true; // behind the light
  }
  const double cosine = 1.0 / std::sqrt(1.0 + static_cast<double>(light.tangentSquared));
  const double sine = std::sqrt(static_cast<double>(light.tangentSquared)) * cosine;
  // A box around the axis is never outside, so the plane may be arbitrary there.
  const glm::dvec3 normal = cosine / std::max(length, noise) * across - sine * axis;
  return Extent(fromLight, normal).lower > noise;
}

/// True if a directional light's box holds no point of another box.
/// @param fromLight the other box relative to the middle of the light's near face
bool isOutsideBox(const Bounds& fromLight, const ShadowRayLight& light, double noise)
{
  const glm::dmat3 axes = glm::transpose(glm::dmat3(light.lightFromCentred));
  const Extent x(fromLight, axes[0]), y(fromLight, axes[1]), z(fromLight, axes[2]);
  const glm::dvec3 box(light.box);
  return x.lower > box.x + noise || x.upper < -box.x - noise || y.lower > box.y + noise ||
    y.upper < -box.y - noise || z.lower > box.z + noise || z.upper < -noise;
}

/// Decides all receivers in a box.
class BoxJudge
{
public:
  BoxJudge(const ShadowLight& light, const Occluders& occluders, const CasterHits& hits)
    : light_(light)
    , occluders_(occluders)
    , hits_(hits)
    , rays_(light, occluders.frame.centre)
    , ends_(light, occluders)
    , casters_(boxesOfCasters(occluders))
    , noise_(floatNoise * largestCoordinate(occluders.allCentred))
  {
  }

  /// @param centred includes the starts of the receivers' rays
  /// @param blocker of the last box in shadow: neighbours mostly share it
  Certainty of(const Bounds& centred, std::optional<std::uint32_t>& blocker) const
  {
    if (centred.empty())
    {
      return Certainty::Unreached;
    }
    const Bounds from = inflated(centred, this->noise_);
    if (this->isUnreached(from))
    {
      return Certainty::Unreached;
    }
    const SweptBox swept(from, this->light_, this->occluders_.frame.centre);
    if (std::none_of(this->casters_.begin(), this->casters_.end(),
          [&](const Bounds& box) { return swept.meets(inflated(box, this->noise_)); }))
    {
      return Certainty::Lit;
    }
    const UmbraProof proof(from, this->ends_, this->occluders_, this->hits_);
    return proof.finds(blocker) ? Certainty::Shadow : Certainty::Uncertain;
  }

private:
  bool isUnreached(const Bounds& from) const
  {
    const glm::dvec3 position(this->rays_.position);
    const Bounds fromLight{ from.lower - position, from.upper - position };
    const double noise = floatNoise * (glm::length(fromLight.centre()) + fromLight.radius());
    return (this->rays_.kind == LightKind::Spot && isOutsideCone(fromLight, this->rays_, noise)) ||
      (this->rays_.hasBox && isOutsideBox(fromLight, this->rays_, noise));
  }

  const ShadowLight& light_;
  const Occluders& occluders_;
  const CasterHits& hits_;
  ShadowRayLight rays_;
  RayEnds ends_;
  std::vector<Bounds> casters_;
  double noise_; ///< upper bound of a float position's error
};

/// A box of a level.
struct Group
{
  std::size_t column, row;
};

/// Return the parts of groups in the level below.
std::vector<Group> partsOf(const std::vector<Group>& groups, const ReceiverBoxes::Level& below)
{
  std::vector<Group> parts;
  parts.reserve(4 * groups.size());
  for (const Group& group : groups)
  {
    for (std::size_t row = 2 * group.row; row < std::min(2 * group.row + 2, below.rows); ++row)
    {
      for (std::size_t column = 2 * group.column;
           column < std::min(2 * group.column + 2, below.columns); ++column)
      {
        parts.push_back({ column, row });
      }
    }
  }
  return parts;
}

/// Judge groups of a level in parallel. The tasks are the same for any number of threads, so the
/// verdicts are, too.
std::vector<Certainty> judged(
  const std::vector<Group>& groups, const ReceiverBoxes::Level& level, const BoxJudge& judge)
{
  constexpr std::size_t groupsOfTask = 64;
  std::vector<Certainty> certainties(groups.size());
  tbb::parallel_for(
    tbb::blocked_range<std::size_t>(0, groups.size(), groupsOfTask),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      std::optional<std::uint32_t> blocker;
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        const std::size_t place = groups[i].row * level.columns + groups[i].column;
        certainties[i] = judge.of(level.boxesCentred[place], blocker);
      }
    },
    tbb::simple_partitioner());
  return certainties;
}

bool isDarkFor(Certainty certainty)
{
  return certainty == Certainty::Shadow || certainty == Certainty::Unreached;
}

} // namespace

TileVerdicts::TileVerdicts(const ShadowLight& light, const Occluders& occluders,
  const ReceiverBoxes& boxes, const CasterHits& hits)
  : boxes_(boxes)
  , cells_(boxes.levels()[0].boxesCentred.size(), Certainty::Uncertain)
  , darkTiles_(boxes.levels()[ReceiverBoxes::levelOfTiles].boxesCentred.size(), 1)
{
  this->decide(light, occluders, hits);
  for (std::size_t i = 0; i < this->cells_.size(); ++i)
  {
    this->darkTiles_[this->tileOf(i)] &= isDarkFor(this->cells_[i]) ? 1 : 0;
  }
}

std::size_t TileVerdicts::tileOf(std::size_t cell) const
{
  const std::size_t columns = this->boxes_.levels()[0].columns;
  return (cell / columns >> ReceiverBoxes::levelOfTiles) *
    this->boxes_.levels()[ReceiverBoxes::levelOfTiles].columns +
    (cell % columns >> ReceiverBoxes::levelOfTiles);
}

void TileVerdicts::decide(
  const ShadowLight& light, const Occluders& occluders, const CasterHits& hits)
{
  const std::vector<ReceiverBoxes::Level>& levels = this->boxes_.levels();
  const BoxJudge judge(light, occluders, hits);
  std::vector<Group> open{ { 0, 0 } };
  for (std::size_t level = levels.size() - 1;; --level)
  {
    const std::vector<Certainty> certainties = judged(open, levels[level], judge);
    std::vector<Group> undecided;
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      const Group& group = open[i];
      if (certainties[i] == Certainty::Uncertain)
      {
        undecided.push_back(group);
        continue;
      }
      const std::size_t firstColumn = group.column << level;
      const std::size_t columns =
        std::min(std::size_t(1) << level, levels[0].columns - firstColumn);
      const std::size_t endRow = std::min((group.row + 1) << level, levels[0].rows);
      for (std::size_t row = group.row << level; row < endRow; ++row)
      {
        std::fill_n(&this->cells_[row * levels[0].columns + firstColumn], columns, certainties[i]);
      }
    }
    const std::size_t decided = open.size() - undecided.size();
    const bool isInVain = level <= ReceiverBoxes::levelOfTiles
      ? leastDecided * decided < open.size()
      : open.size() >= manyInVain && decided == 0;
    if (level == 0 || isInVain)
    {
      return;
    }
    open = partsOf(undecided, levels[level - 1]);
  }
}

bool TileVerdicts::areAllDark() const
{
  return std::find(this->darkTiles_.begin(), this->darkTiles_.end(), 0) == this->darkTiles_.end();
}

bool TileVerdicts::needManyRays() const
{
  const auto open = static_cast<std::size_t>(
    std::count(this->cells_.begin(), this->cells_.end(), Certainty::Uncertain));
  return 8 * open > this->cells_.size();
}

/// Call `visit` for each part of a tile's rows that lies in one cell, with its first and end pixel
/// and what is known of it. Equal neighbours are merged.
template <typename Visit>
void TileVerdicts::visitRows(std::size_t tile, const Visit& visit) const
{
  const std::size_t across = this->boxes_.levels()[ReceiverBoxes::levelOfTiles].columns;
  const std::size_t width = this->boxes_.width();
  const std::size_t firstColumn = tile % across * ReceiverTile::mostColumns;
  const std::size_t firstRow = tile / across * ReceiverTile::mostRows;
  const std::size_t endColumn = std::min(firstColumn + ReceiverTile::mostColumns, width);
  const std::size_t endRow = std::min(firstRow + ReceiverTile::mostRows, this->boxes_.height());
  for (std::size_t row = firstRow; row < endRow; ++row)
  {
    const std::size_t middle = std::min(firstColumn + ReceiverBoxes::cellColumns, endColumn);
    const Certainty left = this->ofPixel(firstColumn, row);
    const Certainty right = this->ofPixel(endColumn - 1, row);
    if (left == right)
    {
      visit(row * width + firstColumn, row * width + endColumn, left);
      continue;
    }
    visit(row * width + firstColumn, row * width + middle, left);
    visit(row * width + middle, row * width + endColumn, right);
  }
}

void TileVerdicts::ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const
{
  const std::size_t across = this->boxes_.levels()[ReceiverBoxes::levelOfTiles].columns;
  const std::size_t width = this->boxes_.width();
  this->visitRows(tile.number(across),
    [&](std::size_t first, std::size_t end, Certainty known)
    {
      if (known != Certainty::Uncertain)
      {
        const std::size_t row = first / width - tile.firstRow;
        const std::size_t column = first % width - tile.firstColumn;
        std::fill_n(&certain[row * tile.columns + column], end - first, known);
      }
    });
}

void TileVerdicts::fillDark(std::size_t tile, float lit, std::vector<float>& visibility) const
{
  this->visitRows(tile,
    [&, lit](std::size_t first, std::size_t end, Certainty)
    {
      const std::uint8_t* const receives = this->boxes_.receives().data();
      float* const to = visibility.data();
      for (std::size_t i = first; i < end; ++i)
      {
        to[i] = receives[i] != 0 ? 0.0f : lit;
      }
    });
}

void TileVerdicts::classifyDark(std::size_t tile, std::vector<std::uint8_t>& classes) const
{
  constexpr auto noReceiver = static_cast<std::uint8_t>(TracedClass::NoReceiver);
  this->visitRows(tile,
    [&](std::size_t first, std::size_t end, Certainty certainty)
    {
      const auto dark = static_cast<std::uint8_t>(certainty);
      const std::uint8_t* const receives = this->boxes_.receives().data();
      std::uint8_t* const to = classes.data();
#pragma GCC ivdep
      for (std::size_t i = first; i < end; ++i)
      {
        to[i] = receives[i] != 0 ? dark : noReceiver;
      }
    });
}

void TileVerdicts::classifyAllDark(std::vector<std::uint8_t>& classes) const
{
  classes.resize(this->boxes_.receives().size());
  for (std::size_t tile = 0; tile < this->darkTiles_.size(); ++tile)
  {
    this->classifyDark(tile, classes);
  }
}

double TileVerdicts::tell(const ShadowLight& light, LightCounts& counts) const
{
  std::vector<std::uint8_t> traced(this->darkTiles_.size(), 0);
  bool hides = false;
  bool reaches = false;
  for (std::size_t i = 0; i < this->cells_.size(); ++i)
  {
    const bool shows = !this->boxes_.levels()[0].boxesCentred[i].empty();
    const std::size_t tile = this->tileOf(i);
    traced[tile] |= this->cells_[i] == Certainty::Uncertain ? 1 : 0;
    hides |= shows && this->cells_[i] == Certainty::Shadow;
    reaches |= shows && this->cells_[i] != Certainty::Unreached;
  }
  counts.tilesDark =
    static_cast<int>(std::count(this->darkTiles_.begin(), this->darkTiles_.end(), std::uint8_t(1)));
  counts.tilesTraced = static_cast<int>(std::count(traced.begin(), traced.end(), std::uint8_t(1)));
  counts.tilesLit =
    static_cast<int>(this->darkTiles_.size()) - counts.tilesDark - counts.tilesTraced;
  counts.skipReason = counts.tilesTraced > 0 ? ""
    : hides && counts.tilesLit == 0          ? "casters hide it from all that is visible"
    : hides   ? "casters hide it from some visible parts, and none is before the others"
    : reaches ? "no caster is between it and what is visible"
    : light.kind == LightKind::Spot ? "its cone reaches nothing visible"
    : light.box                     ? "its box reaches nothing visible"
                                    : "nothing is visible";
  return static_cast<double>(counts.tilesTraced) /
    static_cast<double>(std::max<std::size_t>(this->darkTiles_.size(), 1));
}

} // namespace gnomon
