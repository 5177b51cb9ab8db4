#include "shadowtech/conservative/ConservativeMaps.h"

#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/TextureMemory.h"

namespace gnomon
{

//------------------------------------------------------------------------------
void ConservativeMaps::bake(const LightViews& views, int sizeTexels, const Occluders& occluders)
{
  this->maps_.clear(); // what they had makes room
  requireRoomForMap(sizeof(TexelBounds), sizeTexels, static_cast<int>(views.views.size()));
  this->edges_.update(occluders);
  for (const LightView& view : views.views)
  {
    this->maps_.emplace_back(
      view, views.box.z > 0.0, sizeTexels, occluders, this->edges_, this->covering_);
  }
}

//------------------------------------------------------------------------------
std::vector<std::uint8_t> ConservativeMaps::onCaster(const Occluders& occluders)
{
  std::vector<std::uint8_t> onCaster{ 0 };
  for (const Surface& surface : occluders.surfaces)
  {
    onCaster.push_back(surface.casts && !surface.oneSided ? 1 : 0);
  }
  return onCaster;
}

//------------------------------------------------------------------------------
void ConservativeMaps::ask(const ReceiverPixels& receivers,
  const std::vector<std::uint8_t>& onCaster, std::vector<Certainty>& certain) const
{
  // Whichever map knows is right, so that it does not matter which of them is the point's own.
  for (const ConservativeMap& map : this->maps_)
  {
    map.ask(receivers, onCaster, certain);
  }
}

//------------------------------------------------------------------------------
std::size_t ConservativeMaps::bytes() const
{
  std::size_t bytes = this->edges_.bytes();
  for (const ConservativeMap& map : this->maps_)
  {
    bytes += map.bytes();
  }
  return bytes;
}

} // namespace gnomon
