#pragma once

#include "Scene.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace gnomon::check
{

/// The contents of a visibility file; row 0 on top.
struct VisibilityFile
{
  int width = 0;  ///< in pixels
  int height = 0; ///< in pixels
  Vec3 origin{ 0.0 };
  std::map<std::string, std::vector<float>> channels;

  /// @throws std::runtime_error if the channel is missing
  const std::vector<float>& channel(const std::string& name) const;
  /// Read three channels: name.X, name.Y, name.Z.
  Vec3 vector(const std::string& name, std::size_t pixel) const;
};

/// @throws std::exception with a message that names the file
VisibilityFile readVisibilityFile(const std::string& path);

/// Tolerances for visibility files.
namespace tolerance
{
constexpr double coverageShare = 5e-4;   ///< of all pixels; also for `otherSurface`
constexpr double positionError = 1e-4;   ///< of the distance from the camera
constexpr double normalShare = 5e-4;     ///< of the pixels covered in both
constexpr double visibilityShare = 1e-4; ///< of the pixels that face the light
/// Surfaces with a smaller cosine count as turned away: the side that faces the light is then
/// decided by rounding to float.
constexpr double facingCosine = 1.0 / 1048576.0; // 2^-20
constexpr double visibilityDifference = 0.5;     ///< more than this makes a pixel wrong
} // namespace tolerance

/// Pixels, as y * width + x, row 0 on top; ascending.
using Pixels = std::vector<std::size_t>;

/// Comparison of one light's visibility. In pixels of another surface or face, visibility is
/// compared at the point of that triangle, because the file shows that point.
struct LightResult
{
  std::size_t counted = 0; ///< pixels covered in both, facing the light, in its cone
  Pixels falseLight;       ///< of these, lit in the file and shadowed in truth
  Pixels falseShadow;      ///< of these, shadowed in the file and lit in truth; also NaN
  Pixels unlit;            ///< turned away or outside the cone, but not dark in the file
};

/// Comparison of a file with its scene.
struct Result
{
  std::size_t pixels = 0;
  std::size_t covered = 0;    ///< in the file and in truth
  Pixels coverage;            ///< covered in one of them only
  double positionError = 0.0; ///< largest, as a share of the distance from the camera
  Pixels position;            ///< where the error exceeds the tolerance
  /// Covered in both, but by different triangles, at an edge that the pixel's ray passes more
  /// closely than a rasteriser can tell. This is a difference in coverage, not in position.
  Pixels otherSurface;
  /// As `otherSurface`, where two faces meet in the edge: positions agree, normals do not.
  Pixels otherFace;
  Pixels normal; ///< normals of no triangle at the position, or not on the camera's side
  std::vector<LightResult> lights;

  /// One sentence per tolerance that is exceeded, with the first pixels.
  /// @param width of the picture
  std::vector<std::string> failures(int width = 1) const;
};

/// Render the scene with the check's own rays and compare.
/// @throws std::runtime_error if the file lacks a channel
Result compare(const Scene& scene, const VisibilityFile& file);

} // namespace gnomon::check
