#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// Return points of the square [-1, 1]^2 that keep a distance from each other. Distances wrap
/// around the square's edges, so any shift that wraps around preserves them. The method is dart
/// throwing (Cook 1986) with a distance that shrinks until all points have found a place (McCool
/// and Fiume 1992). The points are the same in every call, on every machine.
std::vector<glm::dvec2> poissonSquare(int points);

/// Return the distance of two points of the square, across its edges if that is shorter.
double wrappedDistance(const glm::dvec2& a, const glm::dvec2& b);

/// Return the largest distance that so many points can have on the square: that of a triangular
/// lattice (Lagae and Dutre 2008, section 2.2).
double largestPoissonDistance(int points);

} // namespace gnomon
