#pragma once

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

/// A grid in coordinates (x, y, z) of a light, z along its rays; for a lamp (x / z, y / z, z).
struct LightGrid
{
  glm::dmat3 lightFromCentred{ 1.0 };
  glm::dvec3 lower{ 0.0 }, upper{ 0.0 };
  glm::dvec3 sides{ 0.0 }; ///< its lengths at its middle
  glm::ivec3 points{ 0 };  ///< along its sides, at both ends, too
};

/// The grids in a light's space around a part of the scene.
///
/// A light that the part surrounds, or nearly, has six grids, one for each side of a cube.
class LightGrids
{
public:
  /// @param corners around the part, centred
  /// @param axes of the part: grids have one of them across the light, as far as that is possible
  LightGrids(
    const std::vector<glm::dvec3>& corners, const ShadowRayLight& light, const glm::dmat3& axes);

  bool isOfLamp() const { return this->isLamp_; }
  bool isCube() const { return this->grids_.size() > 1; }
  /// The grids; none if the part is not before the light. All of a cube have the same points.
  std::vector<LightGrid>& grids() { return this->grids_; }
  const std::vector<LightGrid>& grids() const { return this->grids_; }

  /// Return a centred point's coordinates in a grid's space.
  glm::dvec3 inGrid(const LightGrid& grid, const glm::dvec3& centred) const;

  /// A ray of the light in centred coordinates, by z in the grid's space: from + z * along.
  struct Ray
  {
    glm::dvec3 from, along;
  };
  /// Return the ray through a column of a grid's points. Rays of its border are just within it.
  Ray rayOf(const LightGrid& grid, int x, int y) const;

  /// Return what shaders need to find a point's place, for points in a camera's view coordinates,
  /// as elements of arrays: `<prefix>FromView_LIGHT`, `<prefix>Lower_LIGHT`,
  /// `<prefix>Extent_LIGHT`.
  std::vector<Uniform> uniforms(const std::string& prefix, const ReceiverSpace& space) const;

private:
  bool isLamp_;
  glm::dvec3 origin_; ///< the lamp, or where z is 0; centred
  std::vector<LightGrid> grids_;
};

} // namespace gnomon
