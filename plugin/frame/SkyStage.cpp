#include "plugin/frame/SkyStage.h"

#include "plugin/frame/ReceiversOnCpu.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

namespace gnomon
{

//------------------------------------------------------------------------------
void SkyStage::compute()
{
  const std::optional<SkyPlan>& plan = this->frame_.plan.sky;
  SkyValue& value = this->frame_.view->sky;
  if (!plan)
  {
    value = {};
    return;
  }
  ValueKey key = *this->frame_.view->receivers.key;
  key.add("the sky", std::tuple(plan->sky.model, plan->sky.farthest, plan->directions));
  key.add("up", std::tuple(plan->sky.up.x, plan->sky.up.y, plan->sky.up.z));
  std::string changes = value.key ? key.changesFrom(*value.key) : "there was none";
  if (!changes.empty())
  {
    if (!value.image || value.image->directions() != plan->directions)
    {
      value.image.emplace(plan->directions);
    }
    value.image->clear();
  }
  else if (value.image->batches() < SkyDirections::batches && !plan->few)
  {
    changes = "more directions";
  }
  this->frame_.noteReuse("the view of the sky", changes);
  if (!changes.empty())
  {
    value.key.reset(); // in case of an error
    value.layer.reset();
    this->trace(*plan, *value.image);
    value.key = std::move(key);
  }
  if (value.layer != plan->layer)
  {
    value.image->view(this->view_);
    this->frame_.view->layers.upload(plan->layer, this->view_);
    value.layer = plan->layer;
    this->frame_.endStage("sky: upload");
  }
  this->frame_.counts.skyProgress =
    static_cast<double>(value.image->batches()) / SkyDirections::batches;
}

//------------------------------------------------------------------------------
/// Trace a frame's directions into the view.
void SkyStage::trace(const SkyPlan& plan, SkyImage& image)
{
  this->tracer_.update();
  const EmbreeTracer& tracer = this->tracer_.get();
  Receivers& receivers = this->frame_.onCpu->receivers();
  const Occluders& occluders = this->frame_.onCpu->surfaces();
  std::size_t rays = 0;
  if (plan.few)
  {
    rays = image.traceFew(plan.sky, receivers.all(), occluders, tracer);
  }
  else
  {
    rays = image.trace(plan.sky, receivers, occluders, tracer,
      std::min(image.batches() + plan.batchesOfFrame, SkyDirections::batches));
  }
  this->frame_.counts.raysTraced += static_cast<std::int64_t>(rays);
  this->frame_.endStage("sky: trace");
}

} // namespace gnomon
