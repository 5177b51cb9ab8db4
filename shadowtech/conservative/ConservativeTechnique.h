#ifndef gnomon_shadowtech_conservative_ConservativeTechnique_h
#define gnomon_shadowtech_conservative_ConservativeTechnique_h

#include "shadowtech/base/Technique.h"
#include "shadowtech/conservative/ConservativeMaps.h"

#include <string>

namespace gnomon
{

/// What exact hybrid techniques share: conservative maps decide which receivers are lit or in shadow for
/// certain, and the others get their shadow ray. A technique says by what its maps conclude that a
/// texel is covered.
class ConservativeTechnique : public Technique
{
public:
  void bake(const MapInput& input) override;
  void dropMaps() override;
  std::size_t bytesOfMaps() const override;
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightReport& report) override;

protected:
  explicit ConservativeTechnique(Covering covering);
  /// What its info() is but for the name.
  static TechniqueInfo infoOf(const std::string& name);

private:
  ConservativeMaps maps_;
};

} // namespace gnomon

#endif
