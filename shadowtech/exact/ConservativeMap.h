#pragma once

#include "lights/LightView.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/exact/MapCasters.h"
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
class CellsOnGpu;
struct ReceiverPixels;

/// What a texel says of the receivers in it, by their depth (ConservativeMap).
struct TexelBounds
{
  float litUpTo;          ///< a receiver of no more depth than this is lit
  float litUpToOnCasters; ///< the same of a point of a caster's own surface
  /// For that, shadow rays must start this far off the caster, in world units.
  float leastOffsetOnCasters;
  float shadowFrom; ///< a receiver of more depth than this is in shadow

  /// Up to what depth receivers are lit whose shadow rays start at least so far off their surface.
  /// @param onCaster whether that casts, on both sides
  float litUpToOf(bool onCaster, double leastOffset) const
  {
    return onCaster && leastOffset >= this->leastOffsetOnCasters ? this->litUpToOnCasters
                                                                 : this->litUpTo;
  }
};

/// How receivers are looked up in a map, in float.
struct LookUp
{
  /// To X, Y, Q and W of MapPoint, but for what Q / W has everywhere, `depthOffset`. As a part of Q
  /// that would be rounded in proportion to W's terms, by more than depth changes far from a lamp
  /// that is among its casters.
  glm::mat4 mapFromCentred{ 1.0f };
  float depthOffset = 0.0f; ///< MapSpace::depthOffset, whose rest beyond a float is in the matrix
  /// To z along the view, where the light has a position; else to 1, the distance at which lengths
  /// across parallel rays are what they are.
  glm::vec4 distance{ 0.0f, 0.0f, 0.0f, 1.0f };
  glm::vec2 depthPerUnit{ 0.0f }; ///< MapSpace::depthPerUnit()
  float rounding = 0.0f;          ///< world units that this moves a receiver by, at most
  float largestOffset =
    std::numeric_limits<float>::infinity(); ///< of a shadow ray across the light, at distance 1
  int size = 0;                             ///< texels
};

/// A map of one view of a light which says of a receiver that it is lit for certain, in shadow for
/// certain, or neither.
///
/// *Depth* is a number that is affine on planes across the map, grows along every ray, and spans
/// about [0, 1] over the casters: with (X, Y, W) = texelFromAcross * across coordinates, z / W for
/// parallel rays, and -1 / W for those from a position, then scaled.
class ConservativeMap
{
public:
  /// @param view, hasBox what was drawn (MapRule)
  /// @param texels row by row; none where nothing is certain, as a caster is too near to the light
  ConservativeMap(
    const LightView& view, bool hasBox, const LookUp& lookUp, std::vector<TexelBounds> texels);

  /// Decides receivers that are still uncertain.
  /// @param onCaster by surface + 1, so that `notCovered` + 1 = 0 is the first: whether it casts,
  /// on both sides
  void ask(const ReceiverPixels& receivers, const std::vector<std::uint8_t>& onCaster,
    std::vector<Certainty>& certain) const;

  /// How it sees casters.
  CasterScene sceneOf(const Occluders& occluders) const;
  /// What it knows of all receivers on a triangle, wherever they are.
  /// @param triangle as it is seen by this map
  /// @param leastOffset, mostOffset how far their shadow rays start off it, in world units
  /// @param onCaster whether its surface casts, on both sides
  Certainty ask(const CasterScene& scene, const MapPolygon& triangle, double leastOffset,
    double mostOffset, bool onCaster) const;

  /// What it knows of receivers in a line.
  /// @param onCaster whether their surface casts, on both sides
  Certainty ask(const ReceiverSegment& segment, bool onCaster) const;

  ///@{
  /// What it is made of, from which a test makes maps that have one of the two answers alone:
  /// texels row by row.
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
  /// What is known of 2 x 2 texels at once, 4 x 4 and so on; each level by rows, half as many as
  /// before, rounded up.
  std::vector<std::vector<TexelBounds>> levels_;
};

/// How the casters of one view of a light are drawn into a map.
/// @param hasBox whether the light begins at the near face of a box
using MapRule = std::function<ConservativeMap(const LightView& view, bool hasBox, int sizeTexels,
  const Occluders& occluders, const CasterEdges& edges)>;

/// The rules that are never wrong about a shadow ray, rounding included. docs/theory/exact_maps.md
/// has them and why they hold.
/// @param gpu draws the maps; null: the CPU does. Not for `Covering::Silhouette`, whose parts are
/// drawn one after another
MapRule certainRule(Covering covering, const CellsOnGpu* gpu = nullptr);

/// How exact positions are looked up, with no slack for rounding.
LookUp lookUpOf(const CasterScene& scene, const LightView& view);

} // namespace gnomon
