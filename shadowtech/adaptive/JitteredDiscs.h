#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// Points of the unit disc, from a jittered grid: (x, y) goes to sqrt(y) (cos 2 pi x, sin 2 pi x),
/// which keeps areas (Uralsky, GPU Gems 2, chapter 17). The row of the largest y comes first, so
/// that the first `grid` points lie on the outermost ring, one in each of its `grid` parts: no
/// nearer to the middle than sqrt((grid - 1) / grid). The same ones at every call, on every
/// machine.
/// @param grid the side of the grid, at least 1
/// @param discs how many discs, which differ
/// @return the points of the first disc, of the second, ...
std::vector<glm::vec2> jitteredDiscs(int grid, int discs);

} // namespace gnomon
