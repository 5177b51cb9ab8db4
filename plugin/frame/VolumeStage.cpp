#include "plugin/frame/VolumeStage.h"

#include <algorithm>
#include <iterator>

namespace gnomon
{

//------------------------------------------------------------------------------
const Volumes& VolumeStage::volumes()
{
  if (this->volumes_.update(this->occluders_))
  {
    this->stacks_.clear();
  }
  return this->volumes_;
}

//------------------------------------------------------------------------------
/// Return a light's stacks. They are empty if the light, the volumes or the resolution changed.
VolumeStage::LightStack& VolumeStage::find(const LightPlan& light)
{
  this->volumes(); // drops stacks of other volumes
  const int resolution = this->frame_.wishes.volumeResolution;
  LightStack& found = this->stacks_[light.light.sceneIndex];
  if (found.light != light.identity || found.resolution != resolution)
  {
    found = {};
    found.light = light.identity;
    found.resolution = resolution;
  }
  return found;
}

//------------------------------------------------------------------------------
const VolumeStack& VolumeStage::stackOf(const LightPlan& light)
{
  LightStack& found = this->find(light);
  if (!found.stack)
  {
    const ShadowRayLight rays(light.light, this->occluders_.frame.centre);
    found.stack = std::make_unique<VolumeStack>(this->volumes_, rays, found.resolution);
    this->frame_.endStage("visibility: volumes");
  }
  return *found.stack;
}

//------------------------------------------------------------------------------
const AreaStacks& VolumeStage::areaStacksOf(const LightPlan& light)
{
  LightStack& found = this->find(light);
  if (!found.ofArea)
  {
    found.ofArea = std::make_unique<AreaStacks>(
      this->volumes_, light.light, this->occluders_.frame.centre, found.resolution);
    this->frame_.endStage("visibility: volumes");
  }
  return *found.ofArea;
}

//------------------------------------------------------------------------------
const VolumeTexture& VolumeStage::textureOf(const LightPlan& light)
{
  LightStack& found = this->find(light);
  if (!found.texture)
  {
    found.texture = std::make_unique<VolumeTexture>(this->stackOf(light));
  }
  return *found.texture;
}

//------------------------------------------------------------------------------
void VolumeStage::attach()
{
  for (auto stack = this->stacks_.begin(); stack != this->stacks_.end();)
  {
    const bool isOfFrame = std::any_of(this->frame_.lights.begin(), this->frame_.lights.end(),
      [&](const CastingLight& light) { return light.light().sceneIndex == stack->first; });
    stack = isOfFrame ? std::next(stack) : this->stacks_.erase(stack);
  }
  if (this->volumes().media().empty())
  {
    return;
  }
  for (CastingLight& casting : this->frame_.lights)
  {
    const auto* own = casting.own->as<PointwiseTechnique>();
    const auto* technique =
      own || !casting.atPoints ? own : casting.atPoints->as<PointwiseTechnique>();
    if (technique && !this->stackOf(casting.plan).grids().empty())
    {
      namingLight(casting.light(),
        [&]
        {
          casting.throughVolumes =
            std::make_shared<ThroughVolumes>(*technique, this->textureOf(casting.plan));
        });
    }
  }
}

} // namespace gnomon
