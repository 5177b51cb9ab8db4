#include "shadowtech/transmittance/VolumeStack.h"

#include "lights/LightSamples.h"
#include "shadowtech/base/Bytes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

/// Return the rotation whose z is along a light's rays and whose x is along a volume's axis, as far
/// as that is possible, so that grids of both fit.
glm::dmat3 axesOf(const glm::dvec3& along, const VolumeMedium& medium)
{
  const glm::dmat3 steps = medium.steps();
  glm::dvec3 across(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const glm::dvec3 step = glm::normalize(steps[axis]);
    const glm::dvec3 other = step - glm::dot(step, along) * along;
    across = glm::dot(other, other) > glm::dot(across, across) ? other : across;
  }
  across = glm::normalize(across);
  return glm::transpose(glm::dmat3(across, glm::cross(along, across), along));
}

/// Return the rotations of the sides of a cube: towards +x, -x, +y, -y, +z, -z.
glm::dmat3 axesOfSide(std::size_t side)
{
  const int axis = static_cast<int>(side / 2);
  const double sign = side % 2 == 0 ? 1.0 : -1.0;
  glm::dmat3 rows(0.0);
  rows[0][(axis + 1) % 3] = 1.0;
  rows[1][(axis + 2) % 3] = 1.0;
  rows[2][axis] = sign;
  return glm::transpose(rows);
}

/// Interpolate a grid.
/// @param share of its sides, 0 to 1
double leftAt(const VolumeStack::Grid& grid, const glm::dvec3& share)
{
  const glm::dvec3 point = share * glm::dvec3(grid.points - 1);
  const glm::ivec3 low = glm::min(glm::ivec3(point), grid.points - 2);
  const glm::dvec3 part = point - glm::dvec3(low);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 of(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 weights = glm::mix(1.0 - part, part, glm::dvec3(of));
    const glm::ivec3 at = low + of;
    sum += weights.x * weights.y * weights.z *
      grid.left[(std::size_t(at.z) * std::size_t(grid.points.y) + std::size_t(at.y)) *
          std::size_t(grid.points.x) +
        std::size_t(at.x)];
  }
  return sum / 65535.0;
}

} // namespace

//------------------------------------------------------------------------------
VolumeStack::VolumeStack(const Volumes& volumes, const ShadowRayLight& light, int resolution)
  : isLamp_(light.kind != LightKind::Directional)
  , origin_(light.position)
{
  std::vector<glm::dvec3> corners;
  glm::dvec3 middle(0.0);
  for (const VolumeMedium& medium : volumes.media())
  {
    for (const glm::dvec3& corner : medium.corners())
    {
      corners.push_back(corner);
      middle += corner;
    }
  }
  middle /= static_cast<double>(corners.size());
  Grid grid;
  grid.lower = glm::dvec3(std::numeric_limits<double>::infinity());
  grid.upper = -grid.lower;
  const glm::dvec3 along = this->isLamp_ ? middle - this->origin_ : -glm::dvec3(light.toLight);
  const bool isWithin = !(glm::dot(along, along) > 0.0);
  grid.lightFromCentred =
    axesOf(isWithin ? glm::dvec3(0.0, 0.0, 1.0) : glm::normalize(along), volumes.media().front());
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
      this->add(grid, resolution * 5 / 8);
    }
  }
  else
  {
    for (const glm::dvec3& corner : corners)
    {
      grid.lower = glm::min(grid.lower, this->inGrid(grid, corner));
      grid.upper = glm::max(grid.upper, this->inGrid(grid, corner));
    }
    grid.lower.z = light.hasBox ? std::max(grid.lower.z, 0.0) : grid.lower.z;
    this->add(grid, resolution);
  }
  for (Grid& one : this->grids_)
  {
    this->fill(volumes, one);
  }
}

//------------------------------------------------------------------------------
/// Return a point's coordinates in a grid's space.
glm::dvec3 VolumeStack::inGrid(const Grid& grid, const glm::dvec3& centred) const
{
  const glm::dvec3 light = grid.lightFromCentred * (centred - this->origin_);
  return this->isLamp_ ? glm::dvec3(light.x / light.z, light.y / light.z, light.z) : light;
}

//------------------------------------------------------------------------------
/// Add a grid with points as far apart along its sides as lengths at its middle ask, unless it is
/// empty.
void VolumeStack::add(Grid& grid, int resolution)
{
  if (grid.upper.z > grid.lower.z)
  {
    const double middle = this->isLamp_ ? 0.5 * (grid.lower.z + grid.upper.z) : 1.0;
    const glm::dvec3 extent = (grid.upper - grid.lower) * glm::dvec3(middle, middle, 1.0);
    const double longest = std::max({ extent.x, extent.y, extent.z });
    grid.points = glm::ivec3(glm::ceil(extent * (resolution / longest))) + 1;
    this->grids_.push_back(grid);
  }
}

//------------------------------------------------------------------------------
/// March along the rays of a grid, and keep what is left of each in all slices.
void VolumeStack::fill(const Volumes& volumes, Grid& grid) const
{
  constexpr double opaque = 12.0; // leaves less than a 65535th
  const glm::ivec3& points = grid.points;
  grid.left.resize(std::size_t(points.x) * std::size_t(points.y) * std::size_t(points.z));
  const glm::dmat3 centredFromLight = glm::transpose(grid.lightFromCentred);
  const glm::dvec3 step = (grid.upper - grid.lower) / glm::dvec3(points - 1);
  // Rays along a face of a volume are within it.
  const auto acrossAt = [&](int axis, int i) {
    return grid.lower[axis] + std::clamp<double>(i, 1e-6, points[axis] - 1.0 - 1e-6) * step[axis];
  };
  tbb::parallel_for(0, points.y,
    [&](int y)
    {
      for (int x = 0; x < points.x; ++x)
      {
        const glm::dvec2 across(acrossAt(0, x), acrossAt(1, y));
        const glm::dvec3 from = this->isLamp_
          ? this->origin_
          : this->origin_ + centredFromLight * glm::dvec3(across, 0.0);
        const glm::dvec3 along =
          centredFromLight * (this->isLamp_ ? glm::dvec3(across, 1.0) : glm::dvec3(0.0, 0.0, 1.0));
        std::vector<VolumeMedium::Passage> passages;
        for (const VolumeMedium& medium : volumes.media())
        {
          passages.push_back(medium.passageOf(from, along));
        }
        double depth = 0.0;
        for (int z = 0; z < points.z; ++z)
        {
          const double until = grid.lower.z + z * step.z;
          for (std::size_t i = 0; i < passages.size() && z > 0 && depth < opaque; ++i)
          {
            depth += volumes.media()[i].opticalDepth(passages[i], until - step.z, until, anySteps);
          }
          grid.left[(std::size_t(z) * std::size_t(points.y) + std::size_t(y)) *
              std::size_t(points.x) +
            std::size_t(x)] = static_cast<std::uint16_t>(std::exp(-depth) * 65535.0 + 0.5);
        }
      }
    });
}

//------------------------------------------------------------------------------
glm::dvec3 VolumeStack::transmittanceOf(
  const glm::vec3& origin, const glm::vec3& /*direction*/, float /*rayFar*/) const
{
  for (const Grid& grid : this->grids_)
  {
    const glm::dvec3 at = this->inGrid(grid, glm::dvec3(origin));
    const glm::dvec3 share = (at - grid.lower) / (grid.upper - grid.lower);
    if (share.z > 0.0 && share.x >= 0.0 && share.x <= 1.0 && share.y >= 0.0 && share.y <= 1.0)
    {
      return glm::dvec3(leftAt(grid, glm::min(share, 1.0)));
    }
  }
  return glm::dvec3(1.0);
}

//------------------------------------------------------------------------------
std::size_t VolumeStack::bytes() const
{
  return bytesOfAll(this->grids_, [](const Grid& grid) { return bytesOf(grid.left); });
}

//------------------------------------------------------------------------------
AreaStacks::AreaStacks(
  const Volumes& volumes, const ShadowLight& light, const glm::dvec3& centreWorld, int resolution)
{
  ShadowLight sampled = light;
  sampled.lightSamples = 9; // a square, for all ways to sample
  this->points_ = lightSamples(sampled, centreWorld);
  sampled.area.reset();
  for (const glm::dvec4& point : this->points_)
  {
    const glm::dvec3 place(point);
    sampled.positionWorld = point.w > 0.0 ? centreWorld + place : light.positionWorld;
    sampled.directionWorld = point.w > 0.0 ? light.directionWorld : -place;
    this->stacks_.emplace_back(volumes, ShadowRayLight(sampled, centreWorld), resolution / 2);
  }
}

//------------------------------------------------------------------------------
glm::dvec3 AreaStacks::transmittanceOf(
  const glm::vec3& origin, const glm::vec3& direction, float rayFar) const
{
  const glm::dvec3 from(origin), along(direction);
  const auto distanceTo = [&](const glm::dvec4& point)
  {
    return point.w > 0.0 ? glm::distance(from + along, glm::dvec3(point))
                         : glm::distance(glm::normalize(along), glm::dvec3(point));
  };
  const auto nearest = std::min_element(this->points_.begin(), this->points_.end(),
    [&](const glm::dvec4& a, const glm::dvec4& b) { return distanceTo(a) < distanceTo(b); });
  return this->stacks_[static_cast<std::size_t>(nearest - this->points_.begin())].transmittanceOf(
    origin, direction, rayFar);
}

//------------------------------------------------------------------------------
std::size_t AreaStacks::bytes() const
{
  return bytesOfAll(this->stacks_, &VolumeStack::bytes);
}

} // namespace gnomon
