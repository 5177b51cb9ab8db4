#pragma once

#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
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
    const std::vector<glm::dvec3>& corners, const ShadowRayLight& light, const glm::dmat3& axes)
    : isLamp_(light.kind != LightKind::Directional)
    , origin_(light.position)
  {
    const glm::dvec3 middle = std::accumulate(corners.begin(), corners.end(), glm::dvec3(0.0)) /
      static_cast<double>(corners.size());
    LightGrid grid;
    grid.lower = glm::dvec3(std::numeric_limits<double>::infinity());
    grid.upper = -grid.lower;
    const glm::dvec3 along = this->isLamp_ ? middle - this->origin_ : -glm::dvec3(light.toLight);
    const bool isWithin = !(glm::dot(along, along) > 0.0);
    grid.lightFromCentred =
      rotationTo(isWithin ? glm::dvec3(0.0, 0.0, 1.0) : glm::normalize(along), axes);
    const auto add = [&]
    {
      const double middleZ = this->isLamp_ ? 0.5 * (grid.lower.z + grid.upper.z) : 1.0;
      grid.sides = (grid.upper - grid.lower) * glm::dvec3(middleZ, middleZ, 1.0);
      if (grid.upper.z > grid.lower.z)
      {
        this->grids_.push_back(grid);
      }
    };
    // Steps of a grid are coarse far from its axis.
    const auto isAside = [&](const glm::dvec3& corner)
    {
      const glm::dvec3 toCorner = grid.lightFromCentred * (corner - this->origin_);
      return !(toCorner.z > 0.5 * glm::length(toCorner));
    };
    if (this->isLamp_ && std::any_of(corners.begin(), corners.end(), isAside))
    {
      for (std::size_t side = 0; side < 6; ++side)
      {
        grid.lightFromCentred = axesOfSide(side);
        double farthest = 0.0;
        for (const glm::dvec3& corner : corners)
        {
          farthest = std::max(farthest, (grid.lightFromCentred * (corner - this->origin_)).z);
        }
        constexpr double overlap = 0.01; // of sides, so that rounding leaves no gap
        grid.lower = { -1.0 - overlap, -1.0 - overlap, 0.0 };
        grid.upper = { 1.0 + overlap, 1.0 + overlap, farthest };
        add();
      }
      return;
    }
    for (const glm::dvec3& corner : corners)
    {
      grid.lower = glm::min(grid.lower, this->inGrid(grid, corner));
      grid.upper = glm::max(grid.upper, this->inGrid(grid, corner));
    }
    grid.lower.z = light.hasBox ? std::max(grid.lower.z, 0.0) : grid.lower.z;
    add();
  }

  bool isOfLamp() const { return this->isLamp_; }
  bool isCube() const { return this->grids_.size() > 1; }
  /// The grids; none if the part is not before the light. All of a cube have the same points.
  std::vector<LightGrid>& grids() { return this->grids_; }
  const std::vector<LightGrid>& grids() const { return this->grids_; }

  glm::dvec3 inGrid(const LightGrid& grid, const glm::dvec3& centred) const
  {
    const glm::dvec3 light = grid.lightFromCentred * (centred - this->origin_);
    return this->isLamp_ ? glm::dvec3(light.x / light.z, light.y / light.z, light.z) : light;
  }

  /// A ray of the light in centred coordinates, by z in the grid's space: from + z * along.
  struct Ray
  {
    glm::dvec3 from, along;
  };
  /// Return the ray through a column of a grid's points. Rays of its border are just within it.
  Ray rayOf(const LightGrid& grid, int x, int y) const
  {
    const auto acrossAt = [&](int axis, int i)
    {
      const double last = grid.points[axis] - 1.0;
      return glm::mix(
        grid.lower[axis], grid.upper[axis], std::clamp<double>(i, 1e-6, last - 1e-6) / last);
    };
    const glm::dvec2 across(acrossAt(0, x), acrossAt(1, y));
    const glm::dmat3 centredFromLight = glm::transpose(grid.lightFromCentred);
    if (this->isLamp_)
    {
      return { this->origin_, centredFromLight * glm::dvec3(across, 1.0) };
    }
    return { this->origin_ + centredFromLight * glm::dvec3(across, 0.0),
      centredFromLight * glm::dvec3(0.0, 0.0, 1.0) };
  }

  /// Return what shaders need to find a point's place, for points in a camera's view coordinates,
  /// as elements of arrays: `<prefix>FromView_LIGHT`, `<prefix>Lower_LIGHT`,
  /// `<prefix>Extent_LIGHT`.
  std::vector<Uniform> uniforms(const std::string& prefix, const ReceiverSpace& space) const
  {
    std::vector<Uniform> uniforms;
    const glm::dmat4 toOrigin =
      glm::translate(glm::dmat4(1.0), -this->origin_) * space.centredFromView;
    for (std::size_t i = 0; i < this->grids_.size(); ++i)
    {
      const LightGrid& grid = this->grids_[i];
      const auto add = [&](const char* name, const auto& value) {
        uniforms.push_back({ glslElement(prefix + name + "_LIGHT", i), value });
      };
      add("FromView", glm::mat4(glm::dmat4(grid.lightFromCentred) * toOrigin));
      add("Lower", glm::vec3(grid.lower));
      add("Extent", glm::vec3(grid.upper - grid.lower));
    }
    return uniforms;
  }

private:
  /// Return the rotation whose z is along a light's rays and whose x is along one of the axes, as
  /// far as that is possible.
  static glm::dmat3 rotationTo(const glm::dvec3& along, const glm::dmat3& axes)
  {
    glm::dvec3 across(0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      const glm::dvec3 step = glm::normalize(axes[axis]);
      const glm::dvec3 other = step - glm::dot(step, along) * along;
      across = glm::dot(other, other) > glm::dot(across, across) ? other : across;
    }
    across = glm::normalize(across);
    return glm::transpose(glm::dmat3(across, glm::cross(along, across), along));
  }

  /// Return the rotations of the sides of a cube: towards +x, -x, +y, -y, +z, -z.
  static glm::dmat3 axesOfSide(std::size_t side)
  {
    const int axis = static_cast<int>(side / 2);
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    glm::dmat3 rows(0.0);
    rows[0][(axis + 1) % 3] = 1.0;
    rows[1][(axis + 2) % 3] = 1.0;
    rows[2][axis] = sign;
    return glm::transpose(rows);
  }

  bool isLamp_;
  glm::dvec3 origin_; ///< the lamp, or where z is 0; centred
  std::vector<LightGrid> grids_;
};

} // namespace gnomon
