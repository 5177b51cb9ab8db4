#pragma once

#include "shadowtech/base/Technique.h"

namespace gnomon
{

/// `raytraced`: every pixel by one shadow ray, of area lights by one to each of `light_samples`
/// points. The truth that the other techniques are measured by.
class Raytraced : public CpuScreenTechnique
{
public:
  static TechniqueInfo info();
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightReport& report) override;
};

} // namespace gnomon
