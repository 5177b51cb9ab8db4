#pragma once

#include "lights/LightViews.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/exact/ConservativeMap.h"
#include "shadowtech/exact/TriangleDecisions.h"
#include "shadowtech/mesh/CasterEdges.h"

#include <utility>
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
    const MapRule& rule)
  {
    this->clear(); // frees the old maps' memory first
    this->onCaster_.assign(1, 0);
    for (const Surface& surface : occluders.surfaces)
    {
      this->onCaster_.push_back(surface.casts && !surface.oneSided ? 1 : 0);
    }
    requireRoomForMap(
      4 * sizeof(TexelBounds) / 3, light.mapSizeTexels, static_cast<int>(views.views.size()));
    this->edges_.update(occluders);
    std::vector<ConservativeMap> maps; // kept only if all maps are baked
    for (const LightView& view : views.views)
    {
      maps.push_back(rule(view, views.box.z > 0.0, light.mapSizeTexels, occluders, this->edges_));
    }
    this->maps_ = std::move(maps);
    this->triangles_ = TriangleDecisions(light, occluders, this->maps_);
  }

  /// Drop the maps, which leaves all receivers uncertain.
  void clear()
  {
    this->maps_.clear();
    this->triangles_ = {};
  }

  Certainty ofTriangle(const ReceiverTriangle& triangle) const override
  {
    return this->triangles_.of(triangle);
  }

  Certainty ofSegment(const ReceiverSegment& segment) const override
  {
    // Every map's decision is right, so it does not matter which map the receivers belong to.
    for (const ConservativeMap& map : this->maps_)
    {
      const Certainty certainty = map.ask(segment, this->onCaster_[segment.surface + 1u] != 0);
      if (certainty != Certainty::Uncertain)
      {
        return certainty;
      }
    }
    return Certainty::Uncertain;
  }

  void ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const override
  {
    for (const ConservativeMap& map : this->maps_)
    {
      for (std::size_t row = 0; row < tile.rows; ++row)
      {
        map.ask(tile.receivers, tile.at(0, row), tile.columns, this->onCaster_,
          certain.data() + row * tile.columns);
      }
    }
  }

  std::size_t bytes() const
  {
    return this->edges_.bytes() + this->triangles_.bytes() + bytesOf(this->onCaster_) +
      bytesOfAll(this->maps_, &ConservativeMap::bytes);
  }

private:
  CasterEdges edges_;
  std::vector<ConservativeMap> maps_;
  /// Indexed by surface + 1, so that `notCovered` is at 0: true if the surface casts, on both
  /// sides.
  std::vector<std::uint8_t> onCaster_;
  TriangleDecisions triangles_;
};

} // namespace gnomon
