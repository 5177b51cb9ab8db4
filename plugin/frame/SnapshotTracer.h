#pragma once

#include "plugin/frame/Frame.h"
#include "plugin/frame/TransmittanceStage.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Patches.h"
#include "shadowtech/tracing/SharedTracer.h"

#include <cstddef>
#include <optional>

namespace gnomon
{

/// The structure of a snapshot that answers rays, of all lights and views. It is built where a
/// stage first asks.
class SnapshotTracer
{
public:
  /// @param occluders the snapshot, which lives as long as this
  /// @param patches of the snapshot, likewise, if several processes draw the picture
  /// @param transmittance of the snapshot, likewise
  SnapshotTracer(Frame& frame, const Occluders& occluders, const PatchNames& patches,
    TransmittanceStage& transmittance);

  /// Bring the structure up to date with the snapshot.
  /// @throws std::runtime_error if there is no tracer
  void update();
  /// Return the tracer of the last update.
  EmbreeTracer& get() { return *this->tracer_; }
  /// Return what casters of the last update let through of a light's rays. Some do.
  /// @return valid until the next call
  const RayFilter& filterOf(const LightPlan& light);

  ///@{
  /// Return bytes; 0 if nothing was traced.
  std::size_t bytes() const { return this->tracer_ ? this->tracer_->bytes() : 0; }
  std::size_t bytesOfTable() const { return this->tracer_ ? this->tracer_->bytesOfTable() : 0; }
  std::size_t bytesOfRays() const { return this->tracer_ ? this->tracer_->bytesOfRays() : 0; }
  ///@}

private:
  void updateFilters();

  Frame& frame_;
  const Occluders& occluders_;
  const PatchNames& patches_;
  TransmittanceStage& transmittance_;
  std::optional<SharedTracer> tracer_;
  std::optional<CoarseVolumes> coarse_;
  ///@{
  /// Of sheets and volumes; none if all casters block.
  std::optional<RayFilters> filters_;
  std::optional<RayFilters> ofMeans_; ///< of the sky's rays, and of probes
  ///@}
  std::optional<RayFilters> ofLight_;
};

} // namespace gnomon
