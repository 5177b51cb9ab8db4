#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/penumbra/EdgeTree.h"

namespace gnomon
{

/// `penumbra`: the shadows of an area light as `raytraced` shows them, bit for bit, by a few of its
/// rays. Where no edge of a caster is between a receiver and the light, one ray decides; in
/// penumbras the edges say which of the light's samples are seen alike. Lights without area have
/// one ray for each pixel.
class Penumbra : public CpuScreenTechnique
{
public:
  static TechniqueInfo info();
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightReport& report) override;

private:
  EdgeTree tree_;
};

} // namespace gnomon
