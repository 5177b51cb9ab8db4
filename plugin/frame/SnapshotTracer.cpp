#include "plugin/frame/SnapshotTracer.h"

#include <exception>
#include <utility>
#include <vector>

namespace gnomon
{

SnapshotTracer::SnapshotTracer(Frame& frame, const Occluders& occluders, const PatchNames& patches,
  TransmittanceStage& transmittance)
  : frame_(frame)
  , occluders_(occluders)
  , patches_(patches)
  , transmittance_(transmittance)
{
}

void SnapshotTracer::update()
{
  if (!this->tracer_)
  {
    this->tracer_.emplace();
  }
  this->tracer_->share(this->frame_.ranks->rayExchange(), this->patches_);
  try
  {
    const EmbreeTracer::Update update = this->tracer_->update(this->occluders_);
    this->frame_.counts.bvhBuilds += update.builds;
    this->frame_.counts.bvhRefits += update.refits;
    this->updateFilters();
  }
  catch (const std::exception&)
  {
    this->tracer_.reset(); // it has a part of the casters
    this->filters_.reset();
    this->ofMeans_.reset();
    throw;
  }
  this->frame_.endStage("visibility: build");
}

/// Bring what lets light through up to date.
void SnapshotTracer::updateFilters()
{
  std::vector<const RayFilter*> filters;
  if (const Sheets* const sheets = this->transmittance_.sheets())
  {
    filters.push_back(sheets);
  }
  std::vector<const RayFilter*> ofMeans = filters;
  const Volumes& volumes = this->transmittance_.volumes();
  if (!volumes.media().empty())
  {
    filters.push_back(&volumes);
    ofMeans.push_back(&this->coarse_.emplace(volumes));
  }
  this->filters_.reset();
  this->ofMeans_.reset();
  if (!filters.empty())
  {
    this->filters_.emplace(std::move(filters));
    this->ofMeans_.emplace(std::move(ofMeans));
  }
  this->tracer_->filterSamples(this->ofMeans_ ? &*this->ofMeans_ : nullptr);
}

const RayFilter& SnapshotTracer::filterOf(const LightPlan& light)
{
  if (light.marches || this->transmittance_.volumes().media().empty())
  {
    return *this->filters_;
  }
  std::vector<const RayFilter*> filters;
  if (light.light.area)
  {
    filters.push_back(&this->transmittance_.areaStacksOf(light));
  }
  else
  {
    filters.push_back(&this->transmittance_.stackOf(light));
  }
  if (const Sheets* const sheets = this->transmittance_.sheets())
  {
    filters.push_back(sheets);
  }
  return this->ofLight_.emplace(std::move(filters));
}

} // namespace gnomon
