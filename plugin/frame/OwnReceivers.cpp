#include "plugin/frame/ReceiversOnCpu.h"

#include <algorithm>
#include <utility>

namespace gnomon
{

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

void OwnReceivers::prepare()
{
  Receivers& receivers = this->receivers();
  ReceiversValue& value = this->frame_.view->receivers;
  TracingFacts facts;
  facts.frames = ++value.framesTraced;
  for (const CastingLight& casting : this->frame_.lights)
  {
    if (casting.isStale && casting.isOnCpu())
    {
      const bool byMap = casting.info().conservativeMap && casting.own->usesMap();
      ++(byMap ? facts.imagesByMaps : facts.images);
    }
  }
  if (storesReceivers(facts))
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
