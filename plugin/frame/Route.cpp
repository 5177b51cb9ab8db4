#include "plugin/frame/Route.h"

namespace gnomon
{

//------------------------------------------------------------------------------
RouteChoice chooseRoute(RouteWish wished, const std::string& screenTechnique, bool keepVisibility)
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
  return { Route::Inline,
    wished == RouteWish::Inline
      ? "asked for"
      : "all techniques are functions of the point, so that no prepass is needed" };
}

} // namespace gnomon
