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

/// Why the snapshot cannot hold the solids that a mapper draws; null if it can.
/// @param drawn nothing where VTK cannot read the mapper's arrays
const char* reasonAgainstSolids(
  const std::optional<DrawnSolids>& drawn, vtkMapper* mapper, const glm::dmat4& worldFromModel);

/// Whether a property has lines drawn as tubes, as vtkOpenGLPolyDataMapper::DrawingTubes() says.
bool drawsTubes(vtkProperty* property);

/// The radii of what is sized in pixels, as DrawnBlock has them.
struct PixelSizes
{
  glm::dvec4 pointRadiusFromWorld{ 0.0 };
  glm::dvec4 lineRadiusFromWorld{ 0.0 };
};

/// Those of the shader of vtkOpenGLPolyDataMapper.
PixelSizes pixelSizes(vtkProperty* property, vtkRenderer* renderer);

} // namespace gnomon
