#pragma once

#include "shadowtech/base/Technique.h"

namespace gnomon
{

/// `raytraced`: one shadow ray per pixel, or for area lights one to each of `light_samples` points.
/// It is the reference for all other techniques.
class Raytraced : public CpuScreenTechnique
{
public:
  static TechniqueInfo info();
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts) override;
};

} // namespace gnomon
