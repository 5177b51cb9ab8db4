#pragma once

#include "shadowtech/tracing/EmbreeTracer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

/// Traces the casters of several processes, each of which holds its own part of them: a ray is
/// blocked if any process's casters block it. So processes exchange a bit for each ray, and no
/// geometry. All processes must trace the same pictures from the same receivers in the same order.
class SharedTracer : public EmbreeTracer
{
public:
  /// Replaces bits by those that are set in any process; collective.
  using UniteBits = std::function<void(std::vector<std::uint64_t>& bits)>;

  explicit SharedTracer(UniteBits unite);

  std::size_t bytesOfRays() const override;

private:
  std::size_t tracePicture(const TracedPicture& picture) override;
  std::size_t traceOwn(const TracedPicture& picture, const TracedPicture::SampleRange& samples);

  UniteBits unite_;
  std::vector<std::uint64_t> blocked_; ///< by tile, sample and pixel, a bit each
};

} // namespace gnomon
