#pragma once

#include "lights/SettingsTable.h"

namespace gnomon
{

/// What rays through a light's map take for solid in a texel.
enum class RayLayers
{
  Peeled,  ///< each of the first few casters by itself
  NearFar, ///< all between the first and the last surface
  Near,    ///< all behind the first surface
  Eye      ///< all between the first and the last surface that the camera does not see to be empty
};

/// How a ray is searched for what it meets.
enum class RaySearch
{
  Hierarchical, ///< from cell to cell of a hierarchy: nothing is missed
  Linear        ///< in steps of equal length, with bisection
};

/// What is decided from bounds over a region of the map, before it is searched.
enum class RayClasses
{
  Off,
  Pixels, ///< all rays of a pixel at once
  Rays    ///< and then every ray by itself
};

/// How bounds over the texels of such a map are laid out.
enum class SlabHierarchy
{
  Mips,   ///< a pyramid: squares on a grid
  NBuffer ///< squares around every texel, for as many times the memory as there are levels
};

/// How `montecarlo` follows rays through the map.
struct MonteCarloSettings
{
  int rays = 3; ///< to the cells of a grid of so many along either side of the light
  RayLayers layers = RayLayers::Peeled;
  RaySearch search = RaySearch::Hierarchical;
  RayClasses classify = RayClasses::Rays;
  SlabHierarchy pyramid = SlabHierarchy::Mips;
  int filter = 5; ///< in pixels; 0: none
};
const SettingsTable& monteCarloSettings();

} // namespace gnomon
