#pragma once

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace gnomon
{

/// @file
/// Points of kernels and lights. They are the same in every call, on every machine.

constexpr int poissonPoints = 16;

/// The least distance of two points of the disc. So many discs that fill the plane allow at most 2
/// * sqrt(1 / (2 * sqrt(3) * 16 / pi)) = 0.476 (Lagae and Dutre 2008, section 2.2).
constexpr double poissonDistance = 0.42;

/// Return points of the unit disc, no two of them nearer to each other than poissonDistance.
const std::array<glm::dvec2, poissonPoints>& poissonDisc();

/// Return points of the square [-1, 1]^2 that keep a distance from each other. Distances wrap
/// around the square's edges, so any shift that wraps around preserves them. The method is dart
/// throwing (Cook 1986) with a distance that shrinks until all points have found a place (McCool
/// and Fiume 1992).
std::vector<glm::dvec2> poissonSquare(int points);

/// Return the distance of two points of the square, across its edges if that is shorter.
double wrappedDistance(const glm::dvec2& a, const glm::dvec2& b);

/// Return the largest distance that so many points can have on the square: that of a triangular
/// lattice (Lagae and Dutre 2008, section 2.2).
double largestPoissonDistance(int points);

/// Return points of the unit disc from a jittered grid. (x, y) maps to sqrt(y) (cos 2 pi x, sin 2
/// pi x), which preserves areas (Uralsky, GPU Gems 2, chapter 17).
///
/// The row of the largest y comes first. So the first `grid` points lie on the outermost ring, one
/// in each of its `grid` parts, at a radius of at least sqrt((grid - 1) / grid).
/// @param grid the side of the grid, at least 1
/// @param discs number of different discs
/// @return the points of the first disc, of the second, ...
std::vector<glm::vec2> jitteredDiscs(int grid, int discs);

} // namespace gnomon
