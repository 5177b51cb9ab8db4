#include "plugin/frame/Route.h"

namespace gnomon
{

//------------------------------------------------------------------------------
RouteChoice chooseRoute(
  RouteWish wished, const std::string& screenTechnique, bool keepVisibility, std::size_t lights)
{
  if (!screenTechnique.empty())
  {
    return { Route::Image, "'" + screenTechnique + "' works on the whole screen" };
  }
  if (wished == RouteWish::Image)
  {
    return { Route::Image, "asked for" };
  }
  if (keepVisibility)
  {
    return { Route::Image, "the visibility is kept" };
  }
  if (wished == RouteWish::Inline)
  {
    return { Route::Inline, "asked for" };
  }
  if (lights > mostInlineLights)
  {
    return { Route::Image,
      "shaders would call the techniques of " + std::to_string(lights) + " lights, and " +
        std::to_string(mostInlineLights) + " are the most" };
  }
  return { Route::Inline,
    "all techniques are functions of the point, so that no prepass is needed" };
}

} // namespace gnomon
