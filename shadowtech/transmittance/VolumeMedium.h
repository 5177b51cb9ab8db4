#pragma once

#include "lights/SceneFrame.h"
#include "shadowtech/base/Volume.h"

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <vector>

namespace gnomon
{

/// The medium of a volume, by VTK's definition in the limit of short steps: scalars are
/// interpolated, then mapped to opacity, then scaled by the opacity of the gradient. Independent
/// components with extinctions s and weights w have sum(s^2) / sum(w s).
class VolumeMedium
{
public:
  VolumeMedium(std::shared_ptr<const Volume> volume, const SceneFrame& frame);

  /// Return the corners of the volume's box, centred.
  std::array<glm::dvec3, 8> corners() const;
  /// Return the steps from sample to sample along the grid's axes, in centred coordinates.
  glm::dmat3 steps() const { return glm::dmat3(this->centredFromIndex_); }

  /// Return the extinction at an index within the volume's box, clipping planes aside.
  double extinctionAt(const glm::dvec3& index) const;

  /// A ray's way through the volume's box and between its clipping planes.
  struct Passage
  {
    glm::dvec3 start, along; ///< in indices; the direction's length is the ray's
    double from, until;      ///< in lengths of the direction; from >= until if it passes by
    double modelLength;      ///< of the direction
  };
  /// @param origin, direction centred; the direction of any length but 0
  Passage passageOf(const glm::dvec3& origin, const glm::dvec3& direction) const;
  /// Integrate the extinction along a part of a passage, by midpoints of steps shorter than half a
  /// voxel, or a tenth without interpolation.
  /// @param until may be infinite
  /// @param mostSteps longer steps are taken rather than more
  double opticalDepth(const Passage& passage, double from, double until, int mostSteps) const;

private:
  bool isShown(const glm::dvec3& index) const;
  double scalarAt(const glm::dvec3& index, int component) const;
  double gradientAt(const glm::dvec3& index, const VolumeOpacity& opacity) const;
  double extinctionOf(const VolumeOpacity& opacity, const glm::dvec3& index) const;

  std::shared_ptr<const Volume> volume_;
  glm::dmat4 centredFromIndex_, indexFromCentred_;
  glm::dvec3 lower_, upper_;       ///< the box, in indices
  std::vector<glm::dvec4> planes_; ///< of the box and the clipping planes, in indices, as (n, d)
};

} // namespace gnomon
