#pragma once

#include "Scene.h"
#include "view/LightSights.h"

#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <array>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Explains a pixel: its visibility for each light, and the reason, found by a ray to the light's
/// middle.
class PixelProbe
{
public:
  /// @param images of the frame
  /// @param sights of the same frame
  /// @param nameOf returns the name of a prop of the renderer
  /// @param pixel row 0 at the bottom
  /// @return a line for the pixel, and one for each light that casts
  std::vector<std::string> ask(const VisibilityImages& images, const LightSights& sights,
    const std::function<std::string(const vtkProp*)>& nameOf, const std::array<int, 2>& pixel);

private:
  EmbreeTracer tracer_;
};

} // namespace gnomon::tool
