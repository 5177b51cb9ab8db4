#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/tracing/RayFilter.h"
#include "shadowtech/transmittance/VolumeMedium.h"

#include <glm/glm.hpp>

#include <memory>
#include <vector>

namespace gnomon
{

/// The volumes of a snapshot that cast. A ray that marches through them keeps
/// exp(-integral of extinction).
class Volumes : public RayFilter
{
public:
  /// Bring the media up to date with the snapshot.
  /// @return true if they changed
  bool update(const Occluders& occluders);

  const std::vector<VolumeMedium>& media() const { return this->media_; }
  /// Return the sum over the volumes of VolumeMedium::opticalDepth().
  double opticalDepth(
    const glm::dvec3& origin, const glm::dvec3& direction, double from, double until) const;

  bool isColoured() const override { return false; }
  glm::dvec3 transmittanceOf(
    const glm::vec3& origin, const glm::vec3& direction, float rayFar) const override;

private:
  std::vector<std::shared_ptr<const Volume>> volumes_;
  SceneFrame frame_;
  std::vector<VolumeMedium> media_;
};

} // namespace gnomon
