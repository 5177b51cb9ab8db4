#pragma once

#include <glm/glm.hpp>

#include <array>

namespace gnomon
{

constexpr int poissonPoints = 16;

/// The least distance of two points of the disc. So many discs that fill the plane allow at most 2
/// * sqrt(1 / (2 * sqrt(3) * 16 / pi)) = 0.476 (Lagae and Dutre 2008, section 2.2).
constexpr double poissonDistance = 0.42;

/// Return points of the unit disc, no two of them nearer to each other than poissonDistance. They
/// are the same in every call, on every machine.
const std::array<glm::dvec2, poissonPoints>& poissonDisc();

} // namespace gnomon
