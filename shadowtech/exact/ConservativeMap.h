#pragma once

#include "lights/LightView.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/exact/CellsOnCpu.h"
#include "shadowtech/mesh/CasterShapes.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace gnomon
{

class CasterEdges;
struct ReceiverPixels;

/// Depths up to which a texel decides receivers in it (ConservativeMap).
struct TexelBounds
{
  float litUpTo;          ///< receivers of at most this depth are lit
  float litUpToOnCasters; ///< the same for points on a caster's own surface
  /// World units. For litUpToOnCasters, shadow rays must start at least this far off the caster.
  float leastOffsetOnCasters;
  float shadowFrom; ///< receivers of more than this depth are in shadow

  /// Return the depth up to which receivers are lit.
  /// @param onCaster true if their surface casts, on both sides
  /// @param leastOffset how far off the surface their shadow rays start at least, in world units
  float litUpToOf(bool onCaster, double leastOffset) const
  {
    return onCaster && leastOffset >= this->leastOffsetOnCasters ? this->litUpToOnCasters
                                                                 : this->litUpTo;
  }
};

struct LookUp
{
  /// Maps centred positions to MapPoint's X, Y, Q and W, with Q / W lacking `depthOffset`. As part
  /// of Q, the offset would round in proportion to W's terms. Far from a lamp among its casters,
  /// that is more than depth changes.
  glm::mat4 mapFromCentred{ 1.0f };
  float depthOffset = 0.0f; ///< MapSpace::depthOffset; the matrix holds what float loses of it
  /// Maps centred positions to z along the view for positional lights. For parallel rays it is 1,
  /// the distance at which lengths across the light are true.
  glm::vec4 distance{ 0.0f, 0.0f, 0.0f, 1.0f };
  glm::vec2 depthPerUnit{ 0.0f }; ///< MapSpace::depthPerUnit()
  float rounding = 0.0f;          ///< the most that rounding moves a receiver, in world units
  /// Of a shadow ray's start across the light, at distance 1, in world units.
  float largestOffset = std::numeric_limits<float>::infinity();
  int size = 0; ///< side of the map, in texels
};

/// A map of one view of a light. It decides that a receiver is certainly lit, certainly in shadow,
/// or neither.
///
/// *Depth* is affine on planes across the map and grows along every ray. Let (X, Y, W) =
/// texelFromAcross * across coordinates. Depth is z / W for parallel rays and -1 / W for rays from
/// a position, scaled to span about [0, 1] over the casters.
class ConservativeMap
{
public:
  /// @param view, hasBox the view that was baked (MapRule)
  /// @param texels row by row; empty if a caster too near to the light makes everything uncertain
  ConservativeMap(
    const LightView& view, bool hasBox, const LookUp& lookUp, std::vector<TexelBounds> texels);

  /// Decide receivers that are still uncertain.
  /// @param first, count which of the receivers
  /// @param onCaster indexed by surface + 1, so that `notCovered` is at 0: true if the surface
  /// casts, on both sides
  /// @param certain one for each of them
  void ask(const ReceiverPixels& receivers, std::size_t first, std::size_t count,
    const std::vector<std::uint8_t>& onCaster, Certainty* certain) const;

  /// Return the values that the map's casters share.
  CasterScene sceneOf(const Occluders& occluders) const;
  /// Return what holds for all receivers on a triangle, wherever they are.
  /// @param triangle as seen by this map
  /// @param leastOffset, mostOffset how far their shadow rays start off it, in world units
  /// @param onCaster true if its surface casts, on both sides
  Certainty ask(const CasterScene& scene, const MapPolygon& triangle, double leastOffset,
    double mostOffset, bool onCaster) const;

  /// Return what holds for all receivers on a line.
  /// @param onCaster true if their surface casts, on both sides
  Certainty ask(const ReceiverSegment& segment, bool onCaster) const;

  ///@{
  /// The map's parts, row by row. A test builds maps from them that give only one of the two
  /// answers.
  const LookUp& lookUp() const { return this->lookUp_; }
  const std::vector<TexelBounds>& texels() const { return this->texels_; }
  ///@}
  std::size_t bytes() const;

private:
  void buildLevels();

  LightView view_;
  bool hasBox_;
  LookUp lookUp_;
  std::vector<TexelBounds> texels_;
  /// Bounds of 2 x 2 texels, 4 x 4 and so on. Each level has half of the last one's side, rounded
  /// up, and is stored row by row.
  std::vector<std::vector<TexelBounds>> levels_;
};

/// Bakes the casters of one view of a light into a map.
/// @param hasBox true if the light begins at the near face of a box
using MapRule = std::function<ConservativeMap(const LightView& view, bool hasBox, int sizeTexels,
  const Occluders& occluders, const CasterEdges& edges)>;

/// Return the rule that is never wrong about a shadow ray, rounding included.
/// docs/theory/exact_maps.md proves it.
MapRule certainRule(Covering covering);

/// Return the lookup of exact positions, with no slack for rounding.
LookUp lookUpOf(const CasterScene& scene, const LightView& view);

} // namespace gnomon
