#pragma once

#include "shadowtech/tracing/ShadowTracer.h"

#include <memory>

namespace gnomon
{

/// Shadow rays on the CPU, by Embree in robust mode. It has a structure for each surface.
class EmbreeTracer : public ShadowTracer
{
public:
  /// @throws std::runtime_error where Embree cannot be started
  EmbreeTracer();
  ~EmbreeTracer() override;
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  Update update(const Occluders& occluders) override;

  /// As Embree reports it.
  std::size_t bytes() const override;
  std::size_t bytesOfTable() const override;

private:
  std::size_t tracePicture(const TracedPicture& picture) override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
