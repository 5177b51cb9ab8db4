#include "plugin/frame/SkyStage.h"

#include "plugin/frame/ReceiversOnCpu.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

namespace gnomon
{

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
  if (!changes.empty() && plan->rays == SkyPlan::Rays::None)
  {
    this->showAll(*plan, value);
    return;
  }
  if (!changes.empty())
  {
    if (!value.image || value.image->directions() != plan->directions)
    {
      value.image.emplace(plan->directions);
    }
    value.image->clear();
  }
  else if (value.image->batches() < SkyDirections::batches && plan->rays == SkyPlan::Rays::All)
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

/// Have all receivers see all of the sky.
void SkyStage::showAll(const SkyPlan& plan, SkyValue& value)
{
  this->frame_.counts.skyProgress = 0.0;
  this->frame_.noteReuse("the view of the sky", "the picture moves");
  value.key.reset();
  value.layer.reset();
  const glm::ivec2& size = this->frame_.size;
  this->view_.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), 1.0f);
  this->frame_.view->layers.upload(plan.layer, this->view_);
  this->frame_.endStage("sky: upload");
}

/// Trace a frame's directions.
void SkyStage::trace(const SkyPlan& plan, SkyImage& image)
{
  const double start = steadyMilliseconds();
  this->tracer_.update();
  const EmbreeTracer& tracer = this->tracer_.get();
  Receivers& receivers = this->frame_.onCpu->receivers();
  const Occluders& occluders = this->frame_.onCpu->surfaces();
  std::size_t rays = 0;
  if (plan.rays == SkyPlan::Rays::Few)
  {
    rays = image.traceFew(plan.sky, receivers.all(), occluders, tracer);
  }
  else
  {
    rays = image.trace(plan.sky, receivers, occluders, tracer,
      std::min(image.batches() + plan.batchesOfFrame, SkyDirections::batches));
  }
  this->frame_.counts.raysTraced += static_cast<std::int64_t>(rays);
  this->frame_.counts.skyMilliseconds = steadyMilliseconds() - start;
  this->frame_.endStage("sky: trace");
}

} // namespace gnomon
