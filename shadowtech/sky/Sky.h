#pragma once

#include "lights/SobolPoints.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon
{

/// The radiance of a sky by direction. The numbers are public (vtkGnomonVisibilityFilter).
enum class SkyModel
{
  Uniform = 0, ///< the same from everywhere, from below, too: ambient occlusion
  Dome = 1,    ///< the same above the horizon, none below
  Overcast = 2 ///< CIE's standard sky: three times as bright in the zenith as at the horizon
};

/// A light without place. A point with normal n sees
///     V = 1/pi * integral over directions w with n.w > 0 of L(w) visible(w) n.w dw
/// of it. L is scaled such that a horizontal surface below the open sky sees 1.
struct Sky
{
  SkyModel model = SkyModel::Uniform;
  glm::vec3 up{ 0.0f }; ///< unit; without effect if the sky is uniform
  float farthest = std::numeric_limits<float>::infinity(); ///< surfaces beyond hide nothing
};

/// Return L of a direction. The overcast sky's is 3/7 (1 + 2 sin h) at elevation h (Moon and
/// Spencer 1942; ISO 15469:2004, type 1).
float radianceOf(const Sky& sky, const glm::vec3& direction);

/// Return V without anything in the way. With b the angle from up to the normal, the dome gives
/// (1 + cos b) / 2. The integral of sin h gives 2/(3 pi) (sin b + (pi - b) cos b).
double openView(const Sky& sky, const glm::vec3& normal);

/// Directions around a normal, whose density is in proportion to the cosine of the angle between
/// them (Malley: points of the unit disk, lifted to the hemisphere). Pixels have different ones
/// (SobolPoints).
///
/// The points lie in the cells of a grid. Sixteen batches have each fourth column of each fourth
/// row, so each batch is spread as evenly. How much their answers differ tells the error.
class SkyDirections
{
public:
  static constexpr std::size_t batches = 16;

  /// @param count a power of two, isCount()
  explicit SkyDirections(int count);
  static bool isCount(int count);

  int count() const { return this->count_; }
  const SobolPoints& points() const { return this->points_; }
  /// Return direction `i` of a pixel, unit, with z along the normal.
  glm::vec3 local(int i, const SamplePixel& pixel) const;
  /// Return a fraction of 2^32 that is as even over the directions as they are.
  std::uint32_t chance(int i, const SamplePixel& pixel) const
  {
    return this->points_.point(i, pixel).z;
  }
  /// Return the batch of direction `i`, in the order in which batches are added: a Bayer matrix, so
  /// that those of two, four and eight batches are as even.
  std::size_t batchOf(int i) const;

private:
  int count_;
  int columnBits_;
  SobolPoints points_;
};

/// Return a rotation that takes z to a unit vector (Duff et al. 2017).
glm::mat3 rotationFromZ(const glm::vec3& to);

/// The answers of a point's rays to the sky.
class SkySums
{
public:
  void add(std::size_t batch, float radiance, bool isFree)
  {
    this->all_[batch] += radiance;
    this->seen_[batch] += isFree ? radiance : 0.0f;
  }
  /// Return the estimate of V: the share of radiance seen, of the open sky's. So a point that sees
  /// all has exactly the open sky, and one that sees nothing exactly 0.
  /// @param open openView() of the point
  double view(double open) const;
  /// Return its standard error by how much the batches differ.
  double error(double open) const;

private:
  std::array<float, SkyDirections::batches> all_{};
  std::array<float, SkyDirections::batches> seen_{};
};

} // namespace gnomon
