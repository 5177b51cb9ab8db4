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
/// Storing receivers takes half as long as tracing from them. From then on an image takes a third
/// less, and there are boxes by which tiles need no rays. A map that decides whole triangles spares
/// most receivers of the first two images.
void OwnReceivers::prepare()
{
  constexpr int patience = 2; // frames
  Receivers& receivers = this->receivers();
  ReceiversValue& value = this->frame_.view->receivers;
  int images = 0;
  int decidedByMap = 0;
  for (const CastingLight& casting : this->frame_.lights)
  {
    if (casting.isStale && casting.isOnCpu())
    {
      ++(casting.info().conservativeMap && casting.own->usesMap() ? decidedByMap : images);
    }
  }
  if (++value.framesTraced > patience || images > 1 || images + decidedByMap > 2)
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
