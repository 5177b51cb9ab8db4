#include "shadowtech/conservative/ConservativeMaps.h"

#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/TextureMemory.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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
std::vector<Certainty> ConservativeMaps::ask(
  const ReceiverPixels& receivers, const Occluders& occluders) const
{
  std::vector<std::uint8_t> onCaster{ 0 };
  for (const Surface& surface : occluders.surfaces)
  {
    onCaster.push_back(surface.casts && !surface.oneSided ? 1 : 0);
  }
  std::vector<Certainty> certain(receivers.size(), Certainty::Uncertain);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 4096),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      // Whichever map knows is right, so that it does not matter which of them is the point's own.
      for (const ConservativeMap& map : this->maps_)
      {
        map.ask(receivers, range.begin(), range.size(), onCaster, certain);
      }
    });
  return certain;
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
