#pragma once

#include <map>
#include <string>

namespace gnomon::hard
{

/// @file
/// Bounds for techniques on hard cases, fixed before the cases are drawn. In all cases numbers are
/// finite and in [0, 1], and neither OpenGL nor VTK reports an error.

/// How a cell is judged.
enum class Kind
{
  Truth,  ///< agrees with the independent check (tests/check/Check.h)
  Offset, ///< the truth agrees with that of half and double ray offsets
  Exact,  ///< no pixel differs from ray tracing
  Map,    ///< wrong pixels lie near a shadow's edge
  Plane,  ///< the same, on the floor alone
  Soft    ///< errs little more than on easy scenes
};

namespace bounds
{

///@{
/// For hard shadows: pixels of the picture, texels of the maps.
constexpr int width = 320;
constexpr int height = 240;
constexpr int mapSizeTexels = 512;
///@}
///@{
/// For soft shadows.
constexpr int softWidth = 96;
constexpr int softHeight = 72;
constexpr int truthSamples = 1024; ///< of the truth; techniques have their default
///@}

/// Wrong pixels of maps lie within this many texels of a shadow's edge, in texels of a uniform map
/// of the whole scene. A surface no wider than this in the map, at any map size, counts as edge.
constexpr double edgeTexels = 2.0;

/// The truth changes only within this many pixels of a shadow's edge, with another offset or with
/// another tracer on round balls.
constexpr double truthEdgePixels = 0.5;

/// The bound of soft shadows' mean absolute error, over that of the technique on easy scenes.
constexpr double softFactor = 2.0;

/// Mean absolute errors on the easy scenes, as `gnomon_hard_cases --easy` prints them.
inline const std::map<std::string, double>& easyErrors()
{
  static const std::map<std::string, double> errors = { { "pcss", 0.0031 }, { "sampled", 0.0018 },
    { "montecarlo", 0.0035 } };
  return errors;
}

/// The bound of flicker (Flicker.h), the share of edge pixels that turn right or wrong between
/// frames. It is relative to `nsm` under a turning light. Exact techniques: 0.
constexpr double flickerFactor = 2.0;

} // namespace bounds
} // namespace gnomon::hard
