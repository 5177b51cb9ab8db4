#pragma once

#include "lights/LightViews.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/exact/ConservativeMap.h"
#include "shadowtech/exact/TriangleDecisions.h"
#include "shadowtech/mesh/CasterEdges.h"

#include <vector>

namespace gnomon
{

/// The conservative maps of all of a light's views, and what they know of receivers.
class ConservativeMaps : public ReceiverDecider
{
public:
  /// Draws the casters into a map per view, and decides the triangles that they decide.
  /// @param rule how they are drawn
  /// @throws TextureMemoryError for maps without room; there are none then
  void bake(const ShadowLight& light, const LightViews& views, const Occluders& occluders,
    const MapRule& rule);

  /// Forgets them: nothing is known of any receiver.
  void clear();

  Certainty ofTriangle(const ReceiverTriangle& triangle) const override;
  Certainty ofSegment(const ReceiverSegment& segment) const override;
  void ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const override;

  std::size_t bytes() const;

private:
  CasterEdges edges_;
  std::vector<ConservativeMap> maps_;
  /// By surface + 1, so that `notCovered` + 1 = 0 is the first: whether it casts, on both sides.
  std::vector<std::uint8_t> onCaster_;
  TriangleDecisions triangles_;
};

} // namespace gnomon
