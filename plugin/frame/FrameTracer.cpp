#include "plugin/frame/FrameTracer.h"

#include "shadowtech/tracing/EmbreeTracer.h"
#include "shadowtech/tracing/GpuShadowTracer.h"
#include "shadowtech/tracing/SharedTracer.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon
{

//------------------------------------------------------------------------------
TracerChoice chooseTracer(
  TracerWish wished, const std::string& gpuLacks, const std::string& renderer, Ranks* ranks)
{
  if (ranks)
  {
    if (wished == TracerWish::Gpu)
    {
      throw std::runtime_error(
        "the tracer on the GPU was asked for, but it does not share rays with other processes");
    }
    return { false, true, "several processes draw the picture", ranks, ranks->serial() };
  }
  if (wished == TracerWish::Embree)
  {
    return { false, true, "asked for" };
  }
  if (wished == TracerWish::Gpu)
  {
    if (!gpuLacks.empty())
    {
      throw std::runtime_error("the tracer on the GPU was asked for, but " + gpuLacks);
    }
    return { true, true, "asked for" };
  }
  if (!gpuLacks.empty())
  {
    return { false, false, gpuLacks };
  }
  return isSoftwareRenderer(renderer)
    ? TracerChoice{ false, false, "OpenGL draws by software: " + renderer }
    : TracerChoice{ true, false, "OpenGL draws by hardware: " + renderer };
}

//------------------------------------------------------------------------------
FrameTracer::FrameTracer(OccluderBuffers& buffers, ShaderLibrary& shaders)
  : buffers_(buffers)
  , shaders_(shaders)
{
}

//------------------------------------------------------------------------------
void FrameTracer::areFree(
  std::size_t count, const PointArrays& from, const PointArrays& to, std::uint8_t* free) const
{
  const FreeSegments* const own = this->tracer_ ? this->tracer_->freeSegments() : nullptr;
  if (own)
  {
    own->areFree(count, from, to, free);
    return;
  }
  std::fill_n(free, count, 0); // another tracer is in use
}

//------------------------------------------------------------------------------
ShadowTracer::Update FrameTracer::update(const TracerChoice& choice, const Occluders& occluders)
{
  const bool mayBeOther = choice.gpu && !choice.asked;
  if (!mayBeOther || this->topologyOfFailure_ != occluders.topologyVersion)
  {
    this->gpuFailure_.clear();
  }
  if (this->gpuFailure_.empty())
  {
    try
    {
      return this->updateTaken(choice, occluders);
    }
    catch (const std::exception& error)
    {
      this->tracer_.reset();
      if (!mayBeOther)
      {
        throw;
      }
      this->gpuFailure_ = error.what();
      this->topologyOfFailure_ = occluders.topologyVersion;
    }
  }
  return this->updateTaken(
    { false, false, "tracing on the GPU failed: " + this->gpuFailure_ }, occluders);
}

//------------------------------------------------------------------------------
ShadowTracer::Update FrameTracer::updateTaken(
  const TracerChoice& choice, const Occluders& occluders)
{
  if (!this->tracer_ || this->taken_.gpu != choice.gpu ||
    this->taken_.ranksSerial != choice.ranksSerial)
  {
    this->tracer_.reset(); // frees its memory first
    if (choice.gpu)
    {
      this->tracer_ = std::make_unique<GpuShadowTracer>(this->buffers_, this->shaders_);
    }
    else if (choice.ranks)
    {
      this->tracer_ = std::make_unique<SharedTracer>(
        [ranks = choice.ranks](std::vector<std::uint64_t>& bits) { ranks->uniteBits(bits); });
    }
    else
    {
      this->tracer_ = std::make_unique<EmbreeTracer>();
    }
  }
  this->taken_ = choice;
  return this->tracer_->update(occluders);
}

} // namespace gnomon
