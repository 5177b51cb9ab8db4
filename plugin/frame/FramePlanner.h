#pragma once

#include "plugin/frame/Frame.h"
#include "plugin/frame/SnapshotTracer.h"
#include "plugin/plan/AutoPlan.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/probing/Probes.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon
{

/// Plans a renderer's frames (FramePlan.h): gathers the evidence that a plan needs, and keeps the
/// history that it leaves.
class FramePlanner
{
public:
  /// Bakes a light's map if it is stale.
  using Bake = std::function<void(const ShadowLight& map, LightTechnique& technique)>;
  /// Returns what takes a walk over the props.
  using ReadDeferredFacts = std::function<DeferredFacts()>;

  /// @param occluders the snapshot, which must outlive this
  FramePlanner(
    Frame& frame, const Occluders& occluders, SnapshotTracer& tracer, ShaderLibrary& shaders);

  /// Plan this frame, and take the lights of its plan.
  void plan(const Bake& bake, const ReadDeferredFacts& readDeferredFacts);

  /// Remember how much of the picture had rays, and what the frame took. Choices use times under a
  /// time budget alone.
  /// @param isUsual false if it compiled or built what later frames reuse
  void remember(double milliseconds, bool isUsual);

  std::size_t bytes() const { return this->probes_.bytes(); }

private:
  void takeTimesOfFirst();
  Evidence gather(const EvidenceRequest& request, const LightPlan& resting, const Bake& bake);
  void probe(const PointwiseTechnique& technique, const ShadowLight& map,
    const EvidenceRequest& request, Evidence& evidence);
  bool keepsError(const ShadowLight& other, const ShadowLight& light, double limit);
  void look();

  Frame& frame_;
  const Occluders& occluders_;
  SnapshotTracer& tracer_;
  ShaderLibrary& shaders_;
  AutoHistory history_;
  Probes probes_;
  bool looked_ = false;       ///< true if the probes are this frame's
  double milliseconds_ = 0.0; ///< that this frame's plan took
  std::uint32_t looks_ = 0;
};

} // namespace gnomon
