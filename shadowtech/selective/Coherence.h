#pragma once

#include "shadowtech/selective/ChainTechnique.h"

namespace gnomon
{

/// `coherence`: pixels whose texels disagree are traced, all others get what their texels say
/// (Beister, Ernst, Stamminger, A Hybrid GPU-CPU Renderer, 2005). Of an area light, the texels are
/// those of eight maps, from its centre and from seven points around it, and what they disagree on
/// is traced with all samples. Not exact: texels may agree and be wrong.
class Coherence : public ChainTechnique
{
public:
  static TechniqueInfo info();

protected:
  ChainStages stagesOf(const ShadowSettings& settings) const override;
};

} // namespace gnomon
