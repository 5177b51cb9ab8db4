#include "shadowtech/exact/ConservativeMaps.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/TextureMemory.h"

#include <utility>

namespace gnomon
{

//------------------------------------------------------------------------------
void ConservativeMaps::bake(const ShadowLight& light, const LightViews& views,
  const Occluders& occluders, const MapRule& rule)
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

//------------------------------------------------------------------------------
void ConservativeMaps::clear()
{
  this->maps_.clear();
  this->triangles_ = {};
}

//------------------------------------------------------------------------------
Certainty ConservativeMaps::ofTriangle(const ReceiverTriangle& triangle) const
{
  return this->triangles_.of(triangle);
}

//------------------------------------------------------------------------------
Certainty ConservativeMaps::ofSegment(const ReceiverSegment& segment) const
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

//------------------------------------------------------------------------------
void ConservativeMaps::ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const
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

//------------------------------------------------------------------------------
std::size_t ConservativeMaps::bytes() const
{
  return this->edges_.bytes() + this->triangles_.bytes() + bytesOf(this->onCaster_) +
    bytesOfAll(this->maps_, &ConservativeMap::bytes);
}

} // namespace gnomon
