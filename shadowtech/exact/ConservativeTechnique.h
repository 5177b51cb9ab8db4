#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/exact/ConservativeMaps.h"

#include <string>

namespace gnomon
{

class CellsOnGpu;

/// How a technique's maps are drawn for a light's settings.
/// @param gpu draws them, where they are not drawn by the CPU alone; null: the CPU
using RuleOfSettings = MapRule (*)(const ShadowSettings& settings, const CellsOnGpu* gpu);

/// Conservative maps decide which receivers are lit or in shadow for certain, and the others get
/// their shadow ray.
class ConservativeTechnique : public CpuScreenTechnique
{
public:
  explicit ConservativeTechnique(RuleOfSettings rule)
    : rule_(rule)
  {
  }

  void bake(const MapInput& input) override;
  void dropMaps() override;
  std::size_t bytesOfMaps() const override;
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightReport& report) override;

private:
  RuleOfSettings rule_;
  ConservativeMaps maps_;
};

/// A technique of this kind: a line of a table.
struct ConservativeEntry
{
  TechniqueInfo info;
  RuleOfSettings rule;
};

/// What such a technique is, where its rule is never wrong.
TechniqueInfo infoOfExact(const std::string& name);

} // namespace gnomon
