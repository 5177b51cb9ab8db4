#include "shadowtech/base/LightReach.h"

#include "lights/LightSpace.h"

#include <cmath>

namespace gnomon
{

//------------------------------------------------------------------------------
std::vector<std::string> lightReachDefines(const ShadowLight& light)
{
  std::vector<std::string> defines;
  if (light.kind == LightKind::Spot)
  {
    defines.emplace_back("SPOT");
  }
  if (light.box)
  {
    defines.emplace_back("BOX");
  }
  return defines;
}

//------------------------------------------------------------------------------
std::vector<Uniform> lightReachUniforms(
  const ShadowLight& light, const glm::dvec3& centreWorld, const glm::dmat4& viewFromCentred)
{
  const glm::dmat4 lightFromView =
    lightFromCentred(light, centreWorld) * glm::inverse(viewFromCentred);
  const double tangent = std::tan(glm::radians(light.coneAngleDegrees));
  const LightBox box = light.box.value_or(LightBox());
  return { { "lightFromView", glm::mat4(lightFromView) },
    { "lightCone", static_cast<float>(tangent * tangent) },
    { "lightBox", glm::vec3(0.5 * box.width, 0.5 * box.height, box.depth) } };
}

} // namespace gnomon
