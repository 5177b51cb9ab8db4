#ifndef gnomon_shadowtech_exact_ConservativeTechnique_h
#define gnomon_shadowtech_exact_ConservativeTechnique_h

#include "shadowtech/base/Technique.h"
#include "shadowtech/exact/ConservativeMaps.h"

#include <string>

namespace gnomon
{

/// What hybrid techniques share: conservative maps decide which receivers are lit or in shadow for
/// certain, and the others get their shadow ray. A technique says how its maps are drawn.
class ConservativeTechnique : public Technique
{
public:
  void bake(const MapInput& input) override;
  void dropMaps() override;
  std::size_t bytesOfMaps() const override;
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightReport& report) override;

protected:
  /// How its maps are drawn.
  /// @param gpu who draws them, where they are not drawn by the CPU alone; null: the CPU
  virtual MapRule rule(const ShadowSettings& settings, const CellsOnGpu* gpu) const = 0;
  /// What its info() is, where its maps' rule is never wrong.
  static TechniqueInfo infoOf(const std::string& name);

private:
  ConservativeMaps maps_;
};

} // namespace gnomon

#endif
