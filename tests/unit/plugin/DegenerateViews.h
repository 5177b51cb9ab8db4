#ifndef gnomon_tests_unit_plugin_DegenerateViews_h
#define gnomon_tests_unit_plugin_DegenerateViews_h

#include "LitPlane.h"
#include "PassScene.h"

#include <functional>
#include <vector>

namespace gnomon::test
{

/// Draw a floor and a sphere in one window, under each light whose views are hardest to fit: suns
/// along the axes and in the floor's plane; lamps inside, below, on and far from the casters.
/// @param conesDegrees the lamps' cones; none leaves the lamps out
/// @param choose called once for each light
/// @param draw called after it
void drawDegenerateViews(const std::vector<double>& conesDegrees, const Choose& choose,
  const std::function<void(PassScene&)>& draw);

/// Draw the visibility, which must be finite, and then a frame by the inline route.
void drawByBothRoutes(PassScene& scene);

} // namespace gnomon::test

#endif
