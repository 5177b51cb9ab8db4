#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// Return points of the unit disc from a jittered grid, the same for every call and machine. (x, y)
/// maps to sqrt(y) (cos 2 pi x, sin 2 pi x), which preserves areas (Uralsky, GPU Gems 2, chapter
/// 17).
///
/// The row of the largest y comes first. So the first `grid` points lie on the outermost ring, one
/// in each of its `grid` parts, at a radius of at least sqrt((grid - 1) / grid).
/// @param grid the side of the grid, at least 1
/// @param discs number of different discs
/// @return the points of the first disc, of the second, ...
std::vector<glm::vec2> jitteredDiscs(int grid, int discs);

} // namespace gnomon
