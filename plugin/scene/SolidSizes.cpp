#include "plugin/scene/SolidSizes.h"

#include "plugin/scene/DrawnProps.h"

#include "vtkCamera.h"
#include "vtkMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <glm/gtc/matrix_access.hpp>

#include <cmath>

namespace gnomon
{
namespace
{

/// True if a matrix preserves lengths. VTK draws solids with their lengths before the matrix.
bool keepsLengths(const glm::dmat4& matrix)
{
  const glm::dmat3 linear(matrix);
  const glm::dmat3 off = glm::transpose(linear) * linear - glm::dmat3(1.0);
  constexpr double tolerance = 1e-5;
  bool keeps = glm::row(matrix, 3) == glm::dvec4(0.0, 0.0, 0.0, 1.0);
  for (int column = 0; column < 3; ++column)
  {
    for (int row = 0; row < 3; ++row)
    {
      keeps = keeps && std::abs(off[column][row]) < tolerance;
    }
  }
  return keeps;
}

/// True if a property draws lines as tubes, as in vtkOpenGLPolyDataMapper::DrawingTubes().
bool drawsTubes(vtkProperty* property)
{
  return property->GetRenderLinesAsTubes() && property->GetLineWidth() > 1.0f;
}

} // namespace

const char* reasonAgainstSolids(
  const std::optional<DrawnSolids>& drawn, vtkMapper* mapper, const glm::dmat4& worldFromModel)
{
  if (!drawn)
  {
    return "its arrays are not of floats";
  }
  if (mapper->GetNumberOfClippingPlanes() > 0)
  {
    return "clipped";
  }
  return drawn->cells == SurfaceCells::Sticks && !keepsLengths(worldFromModel)
    ? "its actor is scaled, which VTK draws distorted"
    : nullptr;
}

bool isSizedInPixels(vtkProperty* property)
{
  return property->GetRenderPointsAsSpheres() || drawsTubes(property);
}

PixelSizes pixelSizes(vtkProperty* property, vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  int size[2], corner[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &corner[0], &corner[1]);
  const glm::dmat4 clipFromView =
    toGlm(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  const glm::dvec4 scale = camera->GetParallelProjection()
    ? glm::dvec4(0.0, 0.0, 0.0, 1.0)
    : -glm::row(toGlm(camera->GetViewTransformMatrix()), 2); // the depth
  const glm::dvec4 radiusOfOne = scale / (size[0] * clipFromView[0][0]);
  PixelSizes sizes;
  if (property->GetRenderPointsAsSpheres())
  {
    sizes.pointRadiusFromWorld = static_cast<double>(property->GetPointSize()) * radiusOfOne;
  }
  if (drawsTubes(property))
  {
    sizes.lineRadiusFromWorld = static_cast<double>(property->GetLineWidth()) * radiusOfOne;
  }
  return sizes;
}

} // namespace gnomon
