#pragma once

#include "lights/LightViews.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/exact/ConservativeMap.h"
#include "shadowtech/exact/TriangleDecisions.h"
#include "shadowtech/mesh/CasterEdges.h"

#include <vector>

namespace gnomon
{

/// The conservative maps of all views of a light, and what they decide about receivers.
class ConservativeMaps : public ReceiverDecider
{
public:
  /// Bake a map for each view, and decide the triangles that the maps decide.
  /// @param rule bakes one map
  /// @throws TextureMemoryError without enough memory; there are no maps then
  void bake(const ShadowLight& light, const LightViews& views, const Occluders& occluders,
    const MapRule& rule);

  /// Drop the maps, which leaves all receivers uncertain.
  void clear();

  Certainty ofTriangle(const ReceiverTriangle& triangle) const override;
  Certainty ofSegment(const ReceiverSegment& segment) const override;
  void ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const override;

  std::size_t bytes() const;

private:
  CasterEdges edges_;
  std::vector<ConservativeMap> maps_;
  /// Indexed by surface + 1, so that `notCovered` is at 0: true if the surface casts, on both
  /// sides.
  std::vector<std::uint8_t> onCaster_;
  TriangleDecisions triangles_;
};

} // namespace gnomon
