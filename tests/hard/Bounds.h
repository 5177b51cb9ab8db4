#pragma once

#include <map>
#include <string>

namespace gnomon::hard
{

/// @file
/// What a technique has to keep on hard cases, fixed before they are drawn. That numbers are finite
/// and in [0, 1], and that neither OpenGL nor VTK complains, holds for all.

/// How cells are judged.
enum class Kind
{
  Truth,  ///< agrees with the independent check (tests/check/Check.h)
  Offset, ///< the truth with half and with double its rays' offset
  Exact,  ///< no pixel differs from ray tracing
  Map,    ///< wrong pixels lie near a shadow's edge
  Plane,  ///< the same, on the floor alone
  Soft    ///< errs little more than on easy scenes
};

namespace bounds
{

///@{
/// Of hard shadows: pixels of the picture, texels of the maps.
constexpr int width = 320;
constexpr int height = 240;
constexpr int mapSizeTexels = 512;
///@}
///@{
/// Of soft shadows.
constexpr int softWidth = 96;
constexpr int softHeight = 72;
constexpr int truthSamples = 1024; ///< of the truth; techniques have as many as by default
///@}

/// Wrong pixels of maps lie within so many texels of a shadow's edge: of texels of a uniform map of
/// the whole scene. A surface that is no wider in the map, at any size, is all edge.
constexpr double edgeTexels = 2.0;

/// With another offset, and for another tracer on round balls, the truth changes within so many
/// pixels of a shadow's edge.
constexpr double truthEdgePixels = 0.5;

/// The mean absolute error of soft shadows, over that of the technique on easy scenes.
constexpr double softFactor = 2.0;

/// Means of the mean absolute error on the easy scenes, as `gnomon_hard_cases --easy` prints them.
inline const std::map<std::string, double>& easyErrors()
{
  static const std::map<std::string, double> errors = { { "pcss", 0.0031 }, { "sampled", 0.0018 },
    { "montecarlo", 0.0035 } };
  return errors;
}

/// The share of edge pixels that turn right or wrong from frame to frame (Flicker.h), over that of
/// `nsm` when the light turns. Exact techniques': 0.
constexpr double flickerFactor = 2.0;

} // namespace bounds
} // namespace gnomon::hard
