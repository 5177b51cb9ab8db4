#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon
{

/// The opacity that a volume's transfer functions give to one component of its scalars.
struct VolumeOpacity
{
  int component = 0;
  double weight = 1.0;          ///< of an independent component
  glm::dvec2 range{ 0.0, 1.0 }; ///< of the scalars, which the tables span
  /// By scalar, as texels: per length in the volume's own coordinates.
  std::vector<float> extinctions;
  /// Factors by the gradient's magnitude, from 0 to a quarter of the range. Empty for all
  /// components or for none.
  std::vector<float> ofGradients;
};

/// Return the extinction of a medium that has an opacity at a unit distance.
/// @param opacity 0 to 1, which is as good as infinite
inline float extinctionOf(double opacity, double unitDistance)
{
  constexpr double opaque = 1e30;
  return static_cast<float>(opacity < 1.0 ? -std::log1p(-opacity) / unitDistance : opaque);
}

/// A volume that casts: a grid of scalars with the transfer functions, as VTK draws it.
///
/// *Indices* are continuous grid coordinates: sample i has index i. Scalars of points fill the box
/// between the outermost samples, those of cells half a step more.
struct Volume
{
  glm::ivec3 samples{ 0 };          ///< along the grid's axes, each at least 2
  bool isOfCells = false;           ///< the scalars are the cells'
  bool interpolates = true;         ///< trilinearly, and tables linearly; else the nearest counts
  glm::dmat4 modelFromIndex{ 1.0 }; ///< to the volume's own coordinates
  glm::dmat4 worldFromModel{ 1.0 };
  std::shared_ptr<const float> scalars; ///< a sample's components together, x fastest
  int components = 1;
  /// One for each independent component, or one that decides for all.
  std::vector<VolumeOpacity> opacities;

  ///@{
  /// Samples are shown where the mask's nearest texel is above 0. Texels divide the grid's box.
  glm::ivec3 maskTexels{ 0 };
  std::shared_ptr<const std::uint8_t> mask; ///< null: none
  ///@}
  ///@{
  /// Two planes cut each axis of indices into three; bit i of the flags shows region i, x fastest.
  std::array<glm::dvec2, 3> cropIndices{};
  std::uint32_t cropFlags = allRegions;
  static constexpr std::uint32_t allRegions = 0x7ffffffu;
  ///@}
  /// Shown where n.x + d >= 0, in world coordinates, as (n, d).
  std::vector<glm::dvec4> clipPlanesWorld;

  std::size_t bytes() const
  {
    const auto count = [](const glm::ivec3& of)
    { return std::size_t(of.x) * std::size_t(of.y) * std::size_t(of.z); };
    return count(this->samples) * std::size_t(this->components) * sizeof(float) +
      count(this->maskTexels);
  }
};

} // namespace gnomon
