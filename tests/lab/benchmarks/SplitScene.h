#pragma once

#include "shadowtech/tracing/EmbreeTracer.h"

#include <memory>
#include <random>
#include <vector>

namespace gnomon::test
{

/// How a scene's triangles go to parts.
enum class SplitWay
{
  Scattered, ///< each triangle to a random part
  Blocks,    ///< runs of consecutive triangles
  Slabs      ///< by place along a random direction
};
constexpr int splitWays = 3;

/// A scene, or a part of one, with its tracer.
struct TracedScene
{
  Occluders occluders;
  EmbreeTracer tracer; ///< shares the arrays of occluders
};

/// Return a scene whose triangles are all of `whole`, or those that `isTaken` selects. Vertices,
/// surfaces and centre are the whole's.
/// @param isTaken one value a triangle; empty: all
std::unique_ptr<TracedScene> makeTracedScene(
  const Occluders& whole, const std::vector<bool>& isTaken = {});

/// Return the part that each triangle goes to.
std::vector<int> splitTriangles(
  const Occluders& whole, SplitWay way, int parts, std::mt19937& random);

} // namespace gnomon::test
