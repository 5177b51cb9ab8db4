#include "plugin/frame/Route.h"

namespace gnomon
{

//------------------------------------------------------------------------------
RouteChoice chooseRoute(RouteWish wished, const RouteNeeds& needs)
{
  if (!needs.screenTechnique.empty())
  {
    return { Route::Image, "'" + needs.screenTechnique + "' works on the whole screen" };
  }
  if (wished == RouteWish::Image)
  {
    return { Route::Image, "asked for" };
  }
  if (needs.keepVisibility)
  {
    return { Route::Image, "the visibility is kept" };
  }
  if (wished == RouteWish::Inline)
  {
    return { Route::Inline, "asked for" };
  }
  if (needs.lights > mostInlineLights)
  {
    return { Route::Image,
      "shaders would call the techniques of " + std::to_string(needs.lights) + " lights, and " +
        std::to_string(mostInlineLights) + " are the most" };
  }
  if (needs.headlightOnSamples)
  {
    return { Route::Image,
      "a headlight casts in a window with several samples per pixel, and edges would be dark where "
      "a surface covers a pixel whose centre another one hides" };
  }
  return { Route::Inline,
    "all techniques are functions of the point, so that no prepass is needed" };
}

} // namespace gnomon
