#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// Points of the square [-1, 1]^2 that keep their distance from each other, also across its edges,
/// where it goes on from the opposite side: any shift that wraps around leaves distances as they
/// are. Dart throwing (Cook 1986) with a distance that shrinks until all points have found their
/// place (McCool and Fiume 1992). The same ones at every call, on every machine.
std::vector<glm::dvec2> poissonSquare(int points);

/// The distance of two points of the square across its edges, if that is shorter.
double wrappedDistance(const glm::dvec2& a, const glm::dvec2& b);

/// The largest distance that so many points can have on the square, as a lattice of triangles has
/// it (Lagae and Dutre 2008, section 2.2).
double largestPoissonDistance(int points);

} // namespace gnomon
