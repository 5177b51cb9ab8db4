#include "plugin/frame/TransmittanceStage.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

namespace gnomon
{
namespace
{

/// Return the box around a snapshot's sheets.
Bounds boundsOfSheets(const Occluders& occluders)
{
  Bounds bounds;
  for (const Surface& surface : occluders.surfaces)
  {
    if (surface.sheet)
    {
      bounds.add(surface.boundsCentred);
    }
  }
  return bounds;
}

} // namespace

const Volumes& TransmittanceStage::volumes()
{
  if (this->volumes_.update(this->occluders_))
  {
    this->ofLights_.clear();
  }
  return this->volumes_;
}

const Sheets* TransmittanceStage::sheets()
{
  if (!this->occluders_.hasSheets())
  {
    this->sheets_.reset();
    return nullptr;
  }
  bool changes = true;
  try
  {
    changes = (this->sheets_ ? *this->sheets_ : this->sheets_.emplace()).update(this->occluders_);
  }
  catch (const std::exception&)
  {
    this->sheets_.reset(); // it has a part of the sheets
    throw;
  }
  if (changes)
  {
    for (auto& [sceneIndex, of] : this->ofLights_)
    {
      of.sheets.reset();
    }
  }
  return &*this->sheets_;
}

/// Return a light's stacks and map, without those of others or of another resolution.
TransmittanceStage::OfLight& TransmittanceStage::find(const LightPlan& light)
{
  this->volumes();
  this->sheets();
  const int resolution = this->frame_.wishes.volumeResolution;
  const int texels = light.light.mapSizeTexels / 2;
  OfLight& found = this->ofLights_[light.light.sceneIndex];
  if (found.light != light.identity || found.resolution != resolution)
  {
    found = {};
    found.light = light.identity;
    found.resolution = resolution;
  }
  if (std::exchange(found.texels, texels) != texels)
  {
    found.sheets.reset();
  }
  return found;
}

const VolumeStack& TransmittanceStage::stackOf(const LightPlan& light)
{
  OfLight& found = this->find(light);
  if (!found.stack)
  {
    const ShadowRayLight rays(light.light, this->occluders_.frame.centre);
    found.stack = std::make_unique<VolumeStack>(this->volumes_, rays, found.resolution);
    this->frame_.endStage("visibility: volumes");
  }
  return *found.stack;
}

const AreaStacks& TransmittanceStage::areaStacksOf(const LightPlan& light)
{
  OfLight& found = this->find(light);
  if (!found.ofArea)
  {
    found.ofArea = std::make_unique<AreaStacks>(
      this->volumes_, light.light, this->occluders_.frame.centre, found.resolution);
    this->frame_.endStage("visibility: volumes");
  }
  return *found.ofArea;
}

/// Return what takes its share of a light at points.
std::vector<const PointFilter*> TransmittanceStage::filtersOf(const LightPlan& light)
{
  std::vector<const PointFilter*> filters;
  OfLight& found = this->find(light);
  if (!this->volumes_.media().empty() && !this->stackOf(light).grids().grids().empty())
  {
    if (!found.texture)
    {
      found.texture = std::make_unique<VolumeTexture>(*found.stack);
    }
    filters.push_back(found.texture.get());
  }
  if (!this->sheets_)
  {
    found.sheets.reset();
    return filters;
  }
  if (!found.sheets)
  {
    const ShadowRayLight rays(light.light, this->occluders_.frame.centre);
    found.sheets = std::make_unique<SheetMap>(
      *this->sheets_, boundsOfSheets(this->occluders_), rays, found.texels);
    this->frame_.endStage("maps: sheets");
  }
  if (!found.sheets->empty())
  {
    filters.push_back(found.sheets.get());
  }
  return filters;
}

void TransmittanceStage::attach()
{
  for (auto of = this->ofLights_.begin(); of != this->ofLights_.end();)
  {
    const bool isOfFrame = std::any_of(this->frame_.lights.begin(), this->frame_.lights.end(),
      [&](const CastingLight& light) { return light.light().sceneIndex == of->first; });
    of = isOfFrame ? std::next(of) : this->ofLights_.erase(of);
  }
  for (CastingLight& casting : this->frame_.lights)
  {
    const auto* own = casting.own->as<PointwiseTechnique>();
    const auto* technique =
      own || !casting.atPoints ? own : casting.atPoints->as<PointwiseTechnique>();
    if (!technique || !this->frame_.plan.transmits)
    {
      continue;
    }
    namingLight(casting.light(),
      [&]
      {
        const std::vector<const PointFilter*> filters = this->filtersOf(casting.plan);
        casting.filtered =
          filters.empty() ? nullptr : std::make_shared<FilteredTechnique>(*technique, filters);
      });
  }
}

} // namespace gnomon
