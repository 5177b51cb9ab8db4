#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/penumbra/EdgeTree.h"

namespace gnomon
{

/// `penumbra`: shadows of an area light, bit for bit those of `raytraced`, by few of its rays. If
/// no caster's edge lies between a receiver and the light, one ray decides. In penumbrae, edges
/// tell which samples of the light share a visibility. Lights without area get one ray per pixel.
class Penumbra : public CpuScreenTechnique
{
public:
  static TechniqueInfo info();
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts) override;
  std::size_t bytesOfMaps() const override { return this->tree_.bytes(); }

private:
  EdgeTree tree_;
};

} // namespace gnomon
