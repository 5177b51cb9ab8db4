#pragma once

#include "plugin/scene/MapperInternals.h"

#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <optional>

VTK_ABI_NAMESPACE_BEGIN
class vtkMapper;
class vtkProperty;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Return why the snapshot cannot hold a mapper's solids; null if it can.
/// @param drawn nothing if VTK cannot read the mapper's arrays
const char* reasonAgainstSolids(
  const std::optional<DrawnSolids>& drawn, vtkMapper* mapper, const glm::dmat4& worldFromModel);

/// True if a property draws points as spheres or lines as tubes, whose sizes are in pixels.
bool isSizedInPixels(vtkProperty* property);

/// Radii of solids that are sized in pixels, as in DrawnBlock.
struct PixelSizes
{
  glm::dvec4 pointRadiusFromWorld{ 0.0 };
  glm::dvec4 lineRadiusFromWorld{ 0.0 };
};

/// Return the radii of vtkOpenGLPolyDataMapper's shader.
PixelSizes pixelSizes(vtkProperty* property, vtkRenderer* renderer);

} // namespace gnomon
