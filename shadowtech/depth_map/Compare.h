#pragma once

#include "shadowtech/depth_map/DepthMapTechnique.h"

namespace gnomon
{

/// `compare`: one comparison with the map, at the nearest texel (Williams 1978).
class Compare : public DepthMapTechnique
{
public:
  static TechniqueInfo info();

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

} // namespace gnomon
