#include "plugin/plan/Route.h"

namespace gnomon
{

const char* nameOf(Route route)
{
  constexpr const char* names[] = { "inline", "image", "deferred" };
  return names[static_cast<std::size_t>(route)];
}

RouteChoice chooseRoute(RouteWish wished, const RouteNeeds& needs)
{
  if (wished == RouteWish::Deferred)
  {
    return needs.whyNotDeferred.empty() ? RouteChoice{ Route::Deferred, "asked for" }
                                        : RouteChoice{ Route::Image, needs.whyNotDeferred };
  }
  if (wished == RouteWish::Image)
  {
    return { Route::Image, "asked for" };
  }
  if (!needs.screenTechnique.empty())
  {
    const std::string onScreen = "'" + needs.screenTechnique + "' works on the whole screen";
    return needs.whyNotDeferred.empty() && wished == RouteWish::Auto
      ? RouteChoice{ Route::Deferred, onScreen + ", and all shadows are hard and of one light" }
      : RouteChoice{ Route::Image, onScreen };
  }
  if (needs.keepVisibility)
  {
    return { Route::Image, "the visibility is kept" };
  }
  if (needs.seesSky)
  {
    return { Route::Image, "rays find the view of the sky" };
  }
  if (wished == RouteWish::Inline)
  {
    return { Route::Inline, "asked for" };
  }
  if (needs.lights > mostInlineLights)
  {
    return { Route::Image,
      "shaders can call the techniques of at most " + std::to_string(mostInlineLights) +
        " lights, not " + std::to_string(needs.lights) };
  }
  if (needs.headlightOnSamples)
  {
    return { Route::Image,
      "a headlight casts in a window with several samples per pixel, and edges would be dark where "
      "a surface covers a pixel whose centre another one hides" };
  }
  if (!needs.slowTechnique.empty())
  {
    return { Route::Image,
      "'" + needs.slowTechnique + "' takes longer per point than drawing receivers" };
  }
  return { Route::Inline, "all techniques are functions of the point, so no prepass is needed" };
}

} // namespace gnomon
