#pragma once

#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

namespace gnomon::test
{

/// A ray as the tracers get it, centred.
struct TestedRay
{
  glm::vec3 origin;
  glm::vec3 direction;
  float rayFar; ///< in lengths of the direction
};

/// How far a ray is from the other answer, in roundings.
///
/// A triangle blocks a ray if the ray passes its three edges on their inner side, and meets its
/// plane between start and end. Each of these tests has a margin: its exact value over 2^-24 of the
/// lengths that it multiplies, negative if the ray fails it. A triangle's margin is the least one
/// of its tests, a scene's the largest one of its triangles. So a positive margin means that the
/// ray is blocked, and rounding can decide only where the margin is small.
struct RayMargin
{
  double roundings; ///< the scene's
  /// The largest margin of the triangles whose least test is that of an edge. It is near 0 if the
  /// ray passes an edge that may decide its answer.
  double edgeRoundings;
};

/// The margin, of either sign, below which rounding decides Embree's test. For edges,
/// RaysAtCornersSlipThroughOnlyByARounding (EmbreeTracerTest.cpp) derives it.
constexpr double mostRoundings = 12.0;

/// Compute a ray's margin in double precision.
/// @param occluders with casters that are plain triangles: no instances, solids or cut-outs
RayMargin marginOf(const Occluders& occluders, const TestedRay& ray);

} // namespace gnomon::test
