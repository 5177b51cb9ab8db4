#include "plugin/frame/Route.h"

#include "plugin/vtkGnomonShadowPass.h"

namespace gnomon
{

//------------------------------------------------------------------------------
RouteChoice chooseRoute(int wished, const std::string& screenTechnique, bool keepVisibility)
{
  if (!screenTechnique.empty())
  {
    return { Route::Image, "'" + screenTechnique + "' works on the whole screen" };
  }
  if (wished == vtkGnomonShadowPass::ROUTE_IMAGE)
  {
    return { Route::Image, "asked for" };
  }
  if (keepVisibility)
  {
    return { Route::Image, "the visibility is kept" };
  }
  return { Route::Inline,
    wished == vtkGnomonShadowPass::ROUTE_INLINE
      ? "asked for"
      : "all techniques are functions of the point, so that no prepass is needed" };
}

} // namespace gnomon
