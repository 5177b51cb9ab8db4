#pragma once

#include "shadowtech/tracing/EmbreeTracer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace gnomon
{

/// Traces the casters of this process, or of several processes, each of which holds its own part of
/// them. Then a ray is blocked if any process's casters block it: processes exchange a bit for each
/// ray, and no geometry. All processes must trace the same pictures from the same receivers in the
/// same order.
class SharedTracer : public EmbreeTracer
{
public:
  /// Replaces bits by those that are set in any process; collective.
  using UniteBits = std::function<void(std::vector<std::uint64_t>& bits)>;

  /// Set the exchange between the processes; null: this process traces alone.
  /// @param names of the casters' patches; must outlive the tracer
  void share(UniteBits unite, const PatchNames& names)
  {
    this->unite_ = std::move(unite);
    this->names_ = &names;
  }

  /// Return the bytes cached for the rays of a picture.
  std::size_t bytesOfRays() const;

private:
  std::size_t tracePicture(const TracedPicture& picture) override;
  std::size_t traceOwn(const TracedPicture& picture, const TracedPicture::SampleRange& samples);

  UniteBits unite_;
  const PatchNames* names_ = nullptr;
  std::vector<std::uint64_t> blocked_; ///< by tile, sample and pixel, a bit each
};

} // namespace gnomon
