#pragma once

#include "plugin/scene/SurfaceRecord.h"

#include "lights/vtkGnomonVersions.h"

#include "vtkType.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// A surface of the snapshot by its users' names.
struct SurfaceName
{
  int prop = -1; ///< the number in vtkRenderer::GetViewProps()
  /// The mapper's input, whose cells the surface's triangles are; null otherwise.
  vtkPolyData* data = nullptr;
  SurfaceCells cells = SurfaceCells::Polygons;
  SharedName shared{};

  bool operator==(const SurfaceName& other) const
  {
    return this->prop == other.prop && this->data == other.data && this->cells == other.cells &&
      this->shared == other.shared;
  }
};

/// Names the snapshot's surfaces.
/// @param records of the surfaces, up to date with the renderer's props
std::vector<SurfaceName> surfaceNames(
  vtkRenderer* renderer, const std::vector<SurfaceRecord>& records);

/// The cell of each primitive that VTK draws of a surface with data.
std::vector<vtkIdType> cellsOfPrimitives(const SurfaceName& name);

} // namespace gnomon
