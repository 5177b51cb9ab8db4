#include "shadowtech/exact/ConservativeMap.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/exact/CellsOnCpu.h"

#include <glm/gtc/matrix_access.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace gnomon
{
namespace
{

/// Covers rounding of depths to float, and of the arithmetic on them.
constexpr float depthRounding = 4.76837158e-7f; // 2^-21

/// Return a depth that is certainly less, or more, despite rounding.
float below(float depth)
{
  return std::isfinite(depth) ? depth - depthRounding * (1.0f + std::abs(depth)) : depth;
}
float above(float depth)
{
  return std::isfinite(depth) ? depth + depthRounding * (1.0f + std::abs(depth)) : depth;
}

TexelBounds boundsOf(const Cell& cell)
{
  TexelBounds bounds;
  bounds.litUpTo = below(cell.nearest);
  // The receiver lies on the only layer up to this depth.
  bounds.litUpToOnCasters = std::max(bounds.litUpTo, below(cell.oneLayerUpTo()));
  bounds.leastOffsetOnCasters = cell.noise / static_cast<float>(sharpCosine);
  bounds.shadowFrom = above(std::min(cell.contained, cell.covered));
  return bounds;
}

/// The neutral element of bothOf().
constexpr TexelBounds everyTexel{ std::numeric_limits<float>::infinity(),
  std::numeric_limits<float>::infinity(), 0.0f, -std::numeric_limits<float>::infinity() };

/// Return bounds that hold in both texels.
TexelBounds bothOf(const TexelBounds& a, const TexelBounds& b)
{
  return { std::min(a.litUpTo, b.litUpTo), std::min(a.litUpToOnCasters, b.litUpToOnCasters),
    std::max(a.leastOffsetOnCasters, b.leastOffsetOnCasters),
    std::max(a.shadowFrom, b.shadowFrom) };
}

/// The lookups of a few receivers.
struct Looks
{
  static constexpr std::size_t most = 256;
  std::array<int, most> texel; ///< -1 if the map decides nothing
  ///@{
  /// Bounds on the depth at which the shadow ray starts.
  std::array<float, most> farthest;
  std::array<float, most> nearest;
  ///@}
};

#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
void lookAt(
  const LookUp& map, const ReceiverPixels& receivers, std::size_t first, int count, Looks& looks)
{
  const float* const positionX = &receivers.positionX[first];
  const float* const positionY = &receivers.positionY[first];
  const float* const positionZ = &receivers.positionZ[first];
  const float* const offset = &receivers.offset[first];
  const auto size = static_cast<float>(map.size);
  const glm::mat4& m = map.mapFromCentred;
  const glm::vec4 along = map.distance;
  int* const texel = looks.texel.data();
  float* const farthest = looks.farthest.data();
  float* const nearest = looks.nearest.data();
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
  {
    const float px = positionX[i], py = positionY[i], pz = positionZ[i];
    const float w = m[0].w * px + m[1].w * py + m[2].w * pz + m[3].w;
    const float perW = 1.0f / w;
    const float x = (m[0].x * px + m[1].x * py + m[2].x * pz + m[3].x) * perW;
    const float y = (m[0].y * px + m[1].y * py + m[2].y * pz + m[3].y) * perW;
    const float depth = (m[0].z * px + m[1].z * py + m[2].z * pz + m[3].z) * perW + map.depthOffset;
    const float distance = along.x * px + along.y * py + along.z * pz + along.w;
    // NaN must fail. A shadow ray may start no farther beside its receiver than margins allow.
    const bool holds = (w > 0.0f) & (distance > 0.0f) & (x >= 0.0f) & (y >= 0.0f) & (x < size) &
      (y < size) & (offset[i] <= map.largestOffset * distance);
    const int column = static_cast<int>(holds ? x : 0.0f);
    const int row = static_cast<int>(holds ? y : 0.0f);
    texel[i] = holds ? row * map.size + column : -1;
    const float perUnit = (map.depthPerUnit.x + map.depthPerUnit.y * perW) * perW;
    const float moved = (map.rounding + offset[i]) * perUnit;
    farthest[i] = depth + moved;
    nearest[i] = depth - moved;
  }
}

} // namespace

LookUp lookUpOf(const CasterScene& scene, const LightView& view)
{
  LookUp lookUp;
  lookUp.depthOffset = static_cast<float>(scene.space.depthOffset);
  // The matrix gets the part of the constant that rounding to float loses.
  lookUp.mapFromCentred =
    glm::mat4(scene.space.mapFromCentred(scene.space.depthOffset - lookUp.depthOffset));
  if (scene.space.positional)
  {
    lookUp.distance = glm::vec4(glm::row(view.rays.viewFromCentred, 2));
  }
  lookUp.size = static_cast<int>(scene.space.size);
  return lookUp;
}

MapRule certainRule(Covering covering)
{
  return [covering](const LightView& view, bool hasBox, int sizeTexels, const Occluders& occluders,
           const CasterEdges& edges)
  {
    const CasterScene scene = casterScene(view, hasBox, sizeTexels, occluders);
    LookUp lookUp = lookUpOf(scene, view);
    lookUp.depthPerUnit = glm::vec2(scene.space.depthPerUnit());
    lookUp.rounding = static_cast<float>(scene.lateral);
    lookUp.largestOffset = static_cast<float>(scene.largestOffset(1.0));
    std::vector<TexelBounds> texels(
      static_cast<std::size_t>(sizeTexels) * static_cast<std::size_t>(sizeTexels));
    const TakeCell take = [&](std::size_t i, const Cell& cell) { texels[i] = boundsOf(cell); };
    if (!drawCellsOnCpu(scene, edges, sizeTexels, covering, take))
    {
      texels = {};
    }
    return ConservativeMap(view, hasBox, lookUp, std::move(texels));
  };
}

ConservativeMap::ConservativeMap(
  const LightView& view, bool hasBox, const LookUp& lookUp, std::vector<TexelBounds> texels)
  : view_(view)
  , hasBox_(hasBox)
  , lookUp_(lookUp)
  , texels_(std::move(texels))
{
  if (!this->texels_.empty())
  {
    this->buildLevels();
  }
}

void ConservativeMap::buildLevels()
{
  const std::vector<TexelBounds>* finer = &this->texels_;
  // Lines are at most one tile long, so levels of a few texels are coarse enough.
  for (int size = this->lookUp_.size; size > 8;)
  {
    const int half = (size + 1) / 2;
    std::vector<TexelBounds> level(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
    tbb::parallel_for(0, half,
      [&](int y)
      {
        for (int x = 0; x < half; ++x)
        {
          TexelBounds& bounds = level[static_cast<std::size_t>(y) * static_cast<std::size_t>(half) +
            static_cast<std::size_t>(x)];
          bounds = everyTexel;
          for (int i = 0; i < 4; ++i)
          {
            const int column = std::min(2 * x + (i & 1), size - 1);
            const int row = std::min(2 * y + (i >> 1), size - 1);
            bounds = bothOf(bounds,
              (*finer)[static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
                static_cast<std::size_t>(column)]);
          }
        }
      });
    this->levels_.push_back(std::move(level));
    finer = &this->levels_.back();
    size = half;
  }
}

CasterScene ConservativeMap::sceneOf(const Occluders& occluders) const
{
  return casterScene(this->view_, this->hasBox_, this->lookUp_.size, occluders);
}

Certainty ConservativeMap::ask(const CasterScene& scene, const MapPolygon& triangle,
  double leastOffset, double mostOffset, bool onCaster) const
{
  // Larger triangles are seldom all lit or all in shadow. They have many pixels, so looking up each
  // pixel costs little in proportion.
  constexpr double mostTexels = 4096.0;
  if (this->texels_.empty() || triangle.facing == 0 ||
    mostOffset > scene.largestOffset(triangle.nearestZ))
  {
    return Certainty::Uncertain;
  }
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < triangle.count; ++i)
  {
    const glm::dvec2 corner(triangle.corners[i].x, triangle.corners[i].y);
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  const double size = this->lookUp_.size;
  const glm::dvec2 extent = high - low + 1.0;
  // NaN must fail.
  if (!(low.x >= 0.0 && low.y >= 0.0 && high.x < size && high.y < size &&
        extent.x * extent.y <= mostTexels))
  {
    return Certainty::Uncertain;
  }
  const auto moved = static_cast<float>((scene.lateral + mostOffset) * triangle.depthPerUnit);
  bool lit = true;
  bool shadow = true;
  const auto agrees = [&](int x, int y, float nearest, float farthest)
  {
    const TexelBounds& texel =
      this->texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(this->lookUp_.size) +
        static_cast<std::size_t>(x)];
    lit &= farthest + moved <= texel.litUpToOf(onCaster, leastOffset);
    shadow &= nearest - moved > texel.shadowFrom;
    return lit || shadow;
  };
  return !allTexels(triangle, triangle.margin, this->lookUp_.size, agrees) ? Certainty::Uncertain
    : lit                                                                  ? Certainty::Lit
                                                                           : Certainty::Shadow;
}

Certainty ConservativeMap::ask(const ReceiverSegment& segment, bool onCaster) const
{
  if (this->texels_.empty())
  {
    return Certainty::Uncertain;
  }
  // Look up both ends as lookAt() does. Places, depths and distances between them are between
  // theirs.
  const glm::dmat4 mapFromCentred(this->lookUp_.mapFromCentred);
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-std::numeric_limits<double>::infinity());
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  double perUnit = 0.0;
  for (const glm::dvec3& end : { segment.firstCentred, segment.lastCentred })
  {
    const glm::dvec4 map = mapFromCentred * glm::dvec4(end, 1.0);
    const double distance = glm::dot(glm::dvec4(this->lookUp_.distance), glm::dvec4(end, 1.0));
    const double perW = 1.0 / map.w;
    // NaN must fail.
    if (!(map.w > 0.0 && distance > 0.0 &&
          segment.mostOffset <= this->lookUp_.largestOffset * distance * (1.0 - 1e-6)))
    {
      return Certainty::Uncertain;
    }
    const glm::dvec2 place(map.x * perW, map.y * perW);
    low = glm::min(low, place);
    high = glm::max(high, place);
    const double depth = map.z * perW + this->lookUp_.depthOffset;
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
    perUnit = std::max(
      perUnit, (this->lookUp_.depthPerUnit.x + this->lookUp_.depthPerUnit.y * perW) * perW);
  }
  int size = this->lookUp_.size;
  if (!(low.x >= 0.0 && low.y >= 0.0 && high.x < size && high.y < size))
  {
    return Certainty::Uncertain;
  }
  const double moved = (this->lookUp_.rounding + segment.mostOffset) * perUnit;
  nearest -= moved;
  farthest += moved;
  // Choose a level on which the line meets few texels.
  glm::ivec2 first(low), last(high);
  const std::vector<TexelBounds>* texels = &this->texels_;
  for (std::size_t level = 0;
       level < this->levels_.size() && glm::max(last.x - first.x, last.y - first.y) > 3; ++level)
  {
    first /= 2;
    last /= 2;
    size = (size + 1) / 2;
    texels = &this->levels_[level];
  }
  bool lit = true;
  bool shadow = true;
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      const TexelBounds& texel =
        (*texels)[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
          static_cast<std::size_t>(x)];
      lit &= farthest <= texel.litUpToOf(onCaster, segment.leastOffset);
      shadow &= nearest > texel.shadowFrom;
      if (!lit && !shadow)
      {
        return Certainty::Uncertain;
      }
    }
  }
  return lit ? Certainty::Lit : Certainty::Shadow;
}

void ConservativeMap::ask(const ReceiverPixels& receivers, std::size_t first, std::size_t count,
  const std::vector<std::uint8_t>& onCaster, Certainty* certain) const
{
  if (this->texels_.empty())
  {
    return;
  }
  Looks looks;
  for (std::size_t done = 0; done < count; done += Looks::most)
  {
    const std::size_t part = std::min(Looks::most, count - done);
    Certainty* const certainties = certain + done;
    if (std::all_of(certainties, certainties + part,
          [](Certainty known) { return known != Certainty::Uncertain; }))
    {
      continue;
    }
    const std::size_t from = first + done;
    lookAt(this->lookUp_, receivers, from, static_cast<int>(part), looks);
    const auto isAsked = [&](std::size_t i)
    { return looks.texel[i] >= 0 && certainties[i] == Certainty::Uncertain; };
    const auto texelOf = [&](std::size_t i)
    { return &this->texels_[static_cast<std::size_t>(looks.texel[i])]; };
    for (std::size_t i = 0; i < part; ++i)
    {
      if (isAsked(i))
      {
        __builtin_prefetch(texelOf(i)); // neighbours' texels lie anywhere in memory
      }
    }
    for (std::size_t i = 0; i < part; ++i)
    {
      if (!isAsked(i))
      {
        continue;
      }
      const TexelBounds& texel = *texelOf(i);
      const bool isOnCaster = onCaster[receivers.surface[from + i] + 1u] != 0;
      const bool lit = looks.farthest[i] <= texel.litUpToOf(isOnCaster, receivers.offset[from + i]);
      const bool shadow = looks.nearest[i] > texel.shadowFrom;
      certainties[i] = lit ? Certainty::Lit : shadow ? Certainty::Shadow : Certainty::Uncertain;
    }
  }
}

std::size_t ConservativeMap::bytes() const
{
  return bytesOf(this->texels_) + bytesOfAll(this->levels_, bytesOf<TexelBounds>);
}

} // namespace gnomon
