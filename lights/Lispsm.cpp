#include "lights/Lispsm.h"

#include "lights/MapFit.h"
#include "lights/MapWarp.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{

//------------------------------------------------------------------------------
double lispsmEta(double gammaDegrees, double thetaDegrees)
{
  const double gamma = std::min(gammaDegrees, 180.0 - gammaDegrees);
  const double gammaA = thetaDegrees / 3.0;
  const double gammaB = thetaDegrees;
  const double gammaC = thetaDegrees + 0.3 * (90.0 - thetaDegrees);
  constexpr double etaB = -0.2;
  constexpr double etaC = 0.0;
  // A field of view of 0 or 180 degrees makes one of the intervals empty; it is not entered then.
  if (gamma <= gammaA)
  {
    return -1.0;
  }
  if (gamma < gammaB)
  {
    const double angle = glm::radians(90.0 * (gamma - gammaA) / (gammaB - gammaA));
    return -1.0 + (etaB + 1.0) * (1.0 - std::cos(angle));
  }
  if (gamma < gammaC)
  {
    const double angle = glm::radians(90.0 * (gamma - gammaB) / (gammaC - gammaB));
    return etaB + (etaC - etaB) * std::sin(angle);
  }
  return etaC;
}

//------------------------------------------------------------------------------
double lispsmNear(double alpha, double eta)
{
  const double root = std::sqrt(alpha);
  if (eta <= 0.0)
  {
    return (1.0 + root - eta * (alpha - 1.0)) / ((alpha - 1.0) * (eta + 1.0));
  }
  return 1.0 / ((root - 1.0) * (eta * root + 1.0));
}

//------------------------------------------------------------------------------
glm::dmat3 lispsmFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays)
{
  const std::vector<glm::dvec2> across = rays.across(bodyView);
  const auto frame = warpFrame(bodyView, camera, rays);
  if (!frame)
  {
    return uniformFromAcross(across);
  }
  const double eta = lispsmEta(frame->gammaDegrees, frame->thetaDegrees);
  const double nearWarp = lispsmNear(frame->farthest / frame->nearest, eta);
  if (!(nearWarp < largestNearWarp))
  {
    return uniformFromAcross(across);
  }
  return warpedFromAcross(*frame, nearWarp * frame->depth, across);
}

} // namespace gnomon
