#pragma once

#include "shadowtech/selective/ChainTechnique.h"

namespace gnomon
{

/// `coherence`: pixels whose texels disagree are traced. All others get their texels' status
/// (Beister, Ernst, Stamminger, A Hybrid GPU-CPU Renderer, 2005).
///
/// For an area light, texels of eight maps must agree: of its centre and of seven points around it.
/// Other pixels are traced with all samples. The technique is not exact, as texels may agree and be
/// wrong.
class Coherence : public ChainTechnique
{
public:
  static TechniqueInfo info();

protected:
  ChainStages stagesOf(const ShadowSettings& settings) const override;
};

} // namespace gnomon
