#include "plugin/frame/ReceiversOnCpu.h"

#include <algorithm>
#include <utility>

namespace gnomon
{

//------------------------------------------------------------------------------
Receivers& OwnReceivers::receivers()
{
  ReceiversValue& value = this->frame_.view->receivers;
  const CastingLights& lights = this->frame_.lights;
  const bool findsCurves = this->frame_.plan.sky ||
    std::any_of(lights.begin(), lights.end(),
      [](const CastingLight& casting) { return casting.isOnCpu(); }); // others do not ask for them
  if (!value.onCpu || value.onCpu->findsCurves() != findsCurves)
  {
    if (value.numberOfImages != value.number)
    {
      value.fragmentsBefore.swap(value.images.fragments);
      value.numberBefore = std::exchange(value.numberOfImages, value.number);
    }
    this->readImages();
    value.boxes.reset();
    value.onCpu.emplace(
      value.images, value.drawnSurfaces, this->collector_.occluders(), value.pixels, findsCurves);
    this->frame_.endStage("visibility: read receivers");
  }
  return *value.onCpu;
}

//------------------------------------------------------------------------------
/// Storing receivers takes half as long as tracing from them. From then on an image takes a fifth
/// less, and there are boxes by which tiles need no rays.
void OwnReceivers::prepare()
{
  constexpr int patience = 2; // frames
  Receivers& receivers = this->receivers();
  ReceiversValue& value = this->frame_.view->receivers;
  const auto images = std::count_if(this->frame_.lights.begin(), this->frame_.lights.end(),
    [](const CastingLight& casting)
    {
      const bool isDecidedByMap = casting.info().conservativeMap && casting.own->usesMap();
      return casting.isStale && casting.isOnCpu() && !isDecidedByMap;
    });
  if (++value.framesTraced > patience || images > 1)
  {
    const ReceiverPixels& pixels = receivers.all();
    if (!value.boxes)
    {
      value.boxes.emplace(pixels, this->collector_.occluders());
    }
    this->frame_.endStage("visibility: store receivers");
  }
}

} // namespace gnomon
