#pragma once

#include "lights/Bounds.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon
{

/// Return how far an instance's matrix is from a rotation with scales along orthogonal axes: the
/// product of its columns' lengths over the determinant's magnitude. It is 1 for such a matrix,
/// more for a shear (Hadamard's inequality), infinite for a singular one.
double skewness(const glm::dmat3& linear);

/// The largest skewness of an instance. The bound of ShadowRay.h on the error of Embree's inverse
/// matrix relies on it.
inline constexpr double mostSkewness = 2.0;

/// The range of the lengths of an instance's columns. Within it floats hold the determinant and the
/// inverse at full precision.
inline constexpr double smallestInstanceScale = 9.094947e-13; // 2^-40
inline constexpr double largestInstanceScale = 1.0995116e12;  // 2^40

/// True if floats can transform rays into an instance's own space with an error of at most
/// instanceNoise() (ShadowRay.h).
bool isRegular(const glm::dmat3& linear);

/// Return the box around all instances of some vertices in source coordinates, without those left
/// out. It is as tight as a box around their triangles, because light views are fitted to it.
Bounds instancesBounds(const glm::vec3* positionsSource, std::size_t vertexCount,
  const std::vector<glm::mat4x3>& centredFromSource);

} // namespace gnomon
