#pragma once

#include "lights/Bounds.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon
{

/// How far an instance's matrix is from one that scales along orthogonal axes and turns: the
/// product of its columns' lengths over the determinant's magnitude. 1 for such a matrix, more for
/// a shear (Hadamard's inequality), infinite for a singular one.
double skewness(const glm::dmat3& linear);

/// The most skewness that an instance may have: ShadowRay.h's bound on what Embree's inverse of the
/// matrix is off by counts on it.
inline constexpr double mostSkewness = 2.0;

/// The lengths that an instance's columns may have: with these, floats hold the determinant and the
/// inverse, and keep their precision.
inline constexpr double smallestInstanceScale = 9.094947e-13; // 2^-40
inline constexpr double largestInstanceScale = 1.0995116e12;  // 2^40

/// Whether rays can be taken into an instance's own space in float without losing more than
/// instanceNoise() (ShadowRay.h) says.
bool isRegular(const glm::dmat3& linear);

/// The box around all instances of some vertices in source coordinates, those left out excepted: as
/// tight as around their triangles, since light views are fitted to it.
Bounds instancesBounds(const glm::vec3* positionsSource, std::size_t vertexCount,
  const std::vector<glm::mat4x3>& centredFromSource);

} // namespace gnomon
