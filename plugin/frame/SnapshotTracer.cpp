#include "plugin/frame/SnapshotTracer.h"

#include <exception>

namespace gnomon
{

//------------------------------------------------------------------------------
SnapshotTracer::SnapshotTracer(Frame& frame, const Occluders& occluders, const PatchNames& patches)
  : frame_(frame)
  , occluders_(occluders)
  , patches_(patches)
{
}

//------------------------------------------------------------------------------
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
    this->updateSheets();
  }
  catch (const std::exception&)
  {
    this->tracer_.reset(); // it has a part of the casters
    this->sheets_.reset();
    throw;
  }
  this->frame_.endStage("visibility: build");
}

//------------------------------------------------------------------------------
/// Bring the structure of translucent casters up to date.
void SnapshotTracer::updateSheets()
{
  if (!this->frame_.scene.props.transmits)
  {
    this->sheets_.reset();
  }
  else if (!this->sheets_)
  {
    this->sheets_.emplace();
  }
  if (this->sheets_)
  {
    this->sheets_->update(this->occluders_);
  }
  this->tracer_->filterSamples(this->sheets());
}

} // namespace gnomon
