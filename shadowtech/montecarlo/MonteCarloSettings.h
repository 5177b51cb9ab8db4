#pragma once

#include "lights/SettingsTable.h"

namespace gnomon
{

/// What counts as solid in a texel of a light's map.
enum class RayLayers
{
  Peeled,  ///< each of the first few casters separately
  NearFar, ///< everything between the first and the last surface
  Near,    ///< everything behind the first surface
  /// Everything between the first and the last surface, except what the camera sees to be empty.
  Eye
};

/// How to find what a ray meets.
enum class RaySearch
{
  Hierarchical, ///< from cell to cell of a hierarchy, which misses nothing
  Linear        ///< in steps of equal length, with bisection
};

/// What bounds over a region of the map decide before a search.
enum class RayClasses
{
  Off,
  Pixels, ///< all rays of a pixel at once
  Rays    ///< all rays of a pixel, then each ray
};

/// How bounds over the map's texels are arranged.
enum class SlabHierarchy
{
  Mips,   ///< a pyramid of squares on a grid
  NBuffer ///< squares around every texel, whose memory grows with the number of levels
};

/// The settings of `montecarlo`.
struct MonteCarloSettings
{
  int rays = 3; ///< cells of the grid along either side of the light; each gets a ray
  RayLayers layers = RayLayers::Peeled;
  RaySearch search = RaySearch::Hierarchical;
  RayClasses classify = RayClasses::Rays;
  SlabHierarchy pyramid = SlabHierarchy::Mips;
  int filter = 5; ///< radius in pixels; 0 for none
};
const SettingsTable& monteCarloSettings();

} // namespace gnomon
