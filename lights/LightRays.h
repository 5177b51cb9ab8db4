#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// A light's rays as points of the plane of its map. A ray's *across* coordinates are (x, y) of the
/// light's view space (LightView.h) for parallel rays, and the slopes (x/z, y/z) for rays from a
/// position.
///
/// Every projection of a map is a homography of that plane, `mapFromAcross`. It takes (across, 1)
/// to homogeneous coordinates whose quotients lie in [-1, 1]^2 on the map. It leaves depth alone
/// and moves no shadow: points of one ray stay at one point of the map.
struct LightRays
{
  glm::dmat4 viewFromCentred{ 1.0 }; ///< rigid; z grows away from the light
  bool positional = false;

  /// Return the across coordinates of a point.
  /// @param view point in the light's view space; z must be positive for a positional light
  glm::dvec2 across(const glm::dvec3& view) const
  {
    return this->positional ? glm::dvec2(view) / view.z : glm::dvec2(view);
  }
  std::vector<glm::dvec2> across(const std::vector<glm::dvec3>& view) const
  {
    std::vector<glm::dvec2> result;
    result.reserve(view.size());
    for (const glm::dvec3& point : view)
    {
      result.push_back(this->across(point));
    }
    return result;
  }

  bool operator==(const LightRays& other) const
  {
    return this->viewFromCentred == other.viewFromCentred && this->positional == other.positional;
  }
};

/// Return the image of a point under a homography. The image's w must not be 0.
inline glm::dvec2 mapped(const glm::dmat3& homography, const glm::dvec2& point)
{
  const glm::dvec3 image = homography * glm::dvec3(point, 1.0);
  return glm::dvec2(image) / image.z;
}

} // namespace gnomon
