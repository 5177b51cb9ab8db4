#include "lights/Lispsm.h"

#include "lights/MapFit.h"
#include "lights/MapWarp.h"

#include <cmath>

namespace gnomon
{

double lispsmOptimum(double alpha)
{
  return 1.0 / (std::sqrt(alpha) - 1.0);
}

glm::dmat3 lispsmFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays)
{
  const auto frame = warpFrame(bodyView, camera, rays);
  if (!frame)
  {
    return uniformFromAcross(rays.across(bodyView));
  }
  const double nearWarp = rays.positional
    ? leastAliasingNear(*frame, bodyView, camera, rays)
    : fallOff(*frame, lispsmOptimum(frame->farthest / frame->nearest));
  return warpedOrUniform(*frame, nearWarp, bodyView, camera, rays);
}

std::vector<glm::dmat3> lispsmSeries(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays)
{
  const std::vector<glm::dvec2> across = rays.across(bodyView);
  std::vector<glm::dmat3> result = { uniformFromAcross(across) };
  if (const auto frame = warpFrame(bodyView, camera, rays))
  {
    for (int i = 0; i <= stepsOfSeries; ++i)
    {
      const double share = static_cast<double>(i) / stepsOfSeries;
      const double nearWarp =
        leastNearOfSeries * std::pow(greatestNearOfSeries / leastNearOfSeries, share);
      result.push_back(warpedFromAcross(*frame, nearWarp * frame->depth, across));
    }
  }
  return result;
}

} // namespace gnomon
