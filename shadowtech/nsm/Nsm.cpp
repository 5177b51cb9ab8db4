#include "shadowtech/nsm/Nsm.h"

namespace gnomon
{

TechniqueInfo Nsm::info()
{
  TechniqueInfo info;
  info.name = "nsm";
  info.summary = "hard: the plain shadow map";
  info.pointwise = true;
  info.needsMap = true;
  return info;
}
void Nsm::bake(const MapInput&) {}
std::size_t Nsm::bytesOfMaps() const { return 0; }
std::string Nsm::visibilityGlsl() const { return "shadowtech/nsm/nsm_visibility.glsl"; }
std::vector<Uniform> Nsm::uniforms() const { return {}; }

} // namespace gnomon
