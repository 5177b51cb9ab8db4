#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/RayFilter.h"
#include "shadowtech/transmittance/VolumeMedium.h"

#include <glm/glm.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace gnomon
{

/// The most steps of a ray through one volume.
inline constexpr int anySteps = std::numeric_limits<int>::max();

/// The volumes of a snapshot that cast. A ray that marches through them keeps
/// exp(-integral of extinction).
class Volumes : public RayFilter
{
public:
  /// Bring the media up to date with the snapshot.
  /// @return true if they changed
  bool update(const Occluders& occluders)
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

  const std::vector<VolumeMedium>& media() const { return this->media_; }
  /// Return the sum over the volumes of VolumeMedium::opticalDepth().
  double opticalDepth(const glm::dvec3& origin, const glm::dvec3& direction, double from,
    double until, int mostSteps = anySteps) const
  {
    double depth = 0.0;
    for (const VolumeMedium& medium : this->media_)
    {
      depth += medium.opticalDepth(medium.passageOf(origin, direction), from, until, mostSteps);
    }
    return depth;
  }

  bool isColoured() const override { return false; }
  glm::dvec3 transmittanceOf(
    const glm::vec3& origin, const glm::vec3& direction, float rayFar) const override
  {
    return glm::dvec3(std::exp(
      -this->opticalDepth(glm::dvec3(origin), glm::dvec3(direction), shadowRayNear, rayFar)));
  }

private:
  std::vector<std::shared_ptr<const Volume>> volumes_;
  SceneFrame frame_;
  std::vector<VolumeMedium> media_;
};

/// The same for means over many rays, as of a sky: in few steps.
class CoarseVolumes : public RayFilter
{
public:
  /// @param volumes must outlive this
  explicit CoarseVolumes(const Volumes& volumes)
    : volumes_(volumes)
  {
  }
  bool isColoured() const override { return false; }
  glm::dvec3 transmittanceOf(
    const glm::vec3& origin, const glm::vec3& direction, float rayFar) const override
  {
    constexpr int steps = 32;
    return glm::dvec3(std::exp(-this->volumes_.opticalDepth(
      glm::dvec3(origin), glm::dvec3(direction), shadowRayNear, rayFar, steps)));
  }

private:
  const Volumes& volumes_;
};

} // namespace gnomon
