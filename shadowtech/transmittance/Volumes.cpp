#include "shadowtech/transmittance/Volumes.h"

#include "shadowtech/base/ShadowRay.h"

#include <cmath>

namespace gnomon
{

//------------------------------------------------------------------------------
bool Volumes::update(const Occluders& occluders)
{
  if (this->volumes_ == occluders.volumes && this->frame_ == occluders.frame)
  {
    return false;
  }
  this->volumes_ = occluders.volumes;
  this->frame_ = occluders.frame;
  this->media_.clear();
  for (const std::shared_ptr<const Volume>& volume : this->volumes_)
  {
    this->media_.emplace_back(volume, this->frame_);
  }
  return true;
}

//------------------------------------------------------------------------------
double Volumes::opticalDepth(const glm::dvec3& origin, const glm::dvec3& direction, double from,
  double until, int mostSteps) const
{
  double depth = 0.0;
  for (const VolumeMedium& medium : this->media_)
  {
    depth += medium.opticalDepth(medium.passageOf(origin, direction), from, until, mostSteps);
  }
  return depth;
}

//------------------------------------------------------------------------------
glm::dvec3 Volumes::transmittanceOf(
  const glm::vec3& origin, const glm::vec3& direction, float rayFar) const
{
  return glm::dvec3(std::exp(
    -this->opticalDepth(glm::dvec3(origin), glm::dvec3(direction), shadowRayNear, rayFar)));
}

//------------------------------------------------------------------------------
glm::dvec3 CoarseVolumes::transmittanceOf(
  const glm::vec3& origin, const glm::vec3& direction, float rayFar) const
{
  constexpr int steps = 32;
  return glm::dvec3(std::exp(-this->volumes_.opticalDepth(
    glm::dvec3(origin), glm::dvec3(direction), shadowRayNear, rayFar, steps)));
}

} // namespace gnomon
