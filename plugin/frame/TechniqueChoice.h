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

/// Carries out the plan for lights that leave their technique to the pass (planAuto()), between the
/// stages of lights and route: gathers the evidence that it needs, and keeps its history.
class TechniqueChoice
{
public:
  /// Bakes a light's map if it is stale.
  using Bake =
    std::function<void(const CastingLight&, const ShadowLight& map, LightTechnique& technique)>;

  /// @param occluders the snapshot, which must outlive this
  TechniqueChoice(
    Frame& frame, const Occluders& occluders, SnapshotTracer& tracer, ShaderLibrary& shaders);

  /// Choose for this frame.
  void choose(const Bake& bake);

  /// Record how much of the picture had rays and, with a time budget, the time of the frame, which
  /// OpenGL must have finished.
  /// @param isUsual false if it compiled or built what later frames reuse
  void endFrame(double milliseconds, bool isUsual);

  std::size_t bytes() const { return this->probes_.bytes(); }

private:
  AutoFacts facts() const;
  Evidence gather(const EvidenceRequest& request, const Bake& bake);
  void probe(const PointwiseTechnique& technique, const ShadowLight& map,
    const EvidenceRequest& request, Evidence& evidence);
  bool keepsError(const ShadowLight& other, const ShadowLight& light, double limit);
  void apply(const AutoChoice& choice);
  CastingLight& castingOf(int sceneIndex);
  void look();

  Frame& frame_;
  const Occluders& occluders_;
  SnapshotTracer& tracer_;
  ShaderLibrary& shaders_;
  AutoHistory history_;
  Probes probes_;
  bool looked_ = false; ///< true if the probes are this frame's
  std::uint32_t looks_ = 0;
};

} // namespace gnomon
