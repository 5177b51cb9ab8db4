#include "plugin/scene/MapperInternals.h"

#include "vtkDataSet.h"
#include "vtkDataSetMapper.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkFloatArray.h"
#include "vtkGeometryFilter.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLMoleculeMapper.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLSphereMapper.h"
#include "vtkOpenGLStickMapper.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

namespace gnomon
{
namespace
{

/// Return the kind of cells that a mapper draws with its program for triangles.
SurfaceCells cellsOfTriangles(vtkOpenGLPolyDataMapper* mapper)
{
  if (std::strcmp(mapper->GetClassName(), "vtkOpenGLPolyDataMapper") == 0) // nearly always
  {
    return SurfaceCells::Polygons;
  }
  return mapper->IsA("vtkOpenGLSphereMapper") ? SurfaceCells::Spheres
    : mapper->IsA("vtkOpenGLStickMapper")     ? SurfaceCells::Sticks
                                              : SurfaceCells::Polygons;
}

// VTK tells a render pass neither which primitives a program draws nor the number of the first one.
// That number depends on history: a mapper that has cell colours or was picked counts polygon
// triangles exactly. Others count one triangle per corner less two, including skipped ones. So the
// mapper's own members are read. Naming them through a subclass gives access to them without a
// cast.
struct MapperAccess : vtkOpenGLPolyDataMapper
{
  static std::optional<SurfaceCells> cells(vtkOpenGLPolyDataMapper* mapper)
  {
    const vtkOpenGLHelper* drawing = mapper->*(&MapperAccess::LastBoundBO);
    const auto& primitives = mapper->*(&MapperAccess::Primitives);
    if (drawing == &primitives[PrimitivePoints])
    {
      return SurfaceCells::PointSpheres;
    }
    if (drawing == &primitives[PrimitiveLines])
    {
      return SurfaceCells::LineTubes;
    }
    if (drawing == &primitives[PrimitiveTris])
    {
      return cellsOfTriangles(mapper);
    }
    if (drawing == &primitives[PrimitiveTriStrips])
    {
      return SurfaceCells::Strips;
    }
    return std::nullopt;
  }
  static vtkIdType primitiveOffset(vtkOpenGLPolyDataMapper* mapper)
  {
    return mapper->*(&MapperAccess::PrimitiveIDOffset);
  }
  static const char* coordinatesArray(vtkOpenGLPolyDataMapper* mapper, const std::string& texture)
  {
    const auto& attributes = mapper->*(&MapperAccess::ExtraAttributes);
    const auto found = std::find_if(attributes.begin(), attributes.end(),
      [&](const auto& attribute) { return attribute.second.TextureName == texture; });
    return found != attributes.end() ? found->second.DataArrayName.c_str() : nullptr;
  }
};

struct SphereMapperAccess : vtkOpenGLSphereMapper
{
  static const char* scales(vtkOpenGLSphereMapper* mapper)
  {
    return mapper->*(&SphereMapperAccess::ScaleArray);
  }
  static float radius(vtkOpenGLSphereMapper* mapper)
  {
    return mapper->*(&SphereMapperAccess::Radius);
  }
};

struct StickMapperAccess : vtkOpenGLStickMapper
{
  static const char* scales(vtkOpenGLStickMapper* mapper)
  {
    return mapper->*(&StickMapperAccess::ScaleArray);
  }
  static const char* directions(vtkOpenGLStickMapper* mapper)
  {
    return mapper->*(&StickMapperAccess::OrientationArray);
  }
};

struct MoleculeMapperAccess : vtkOpenGLMoleculeMapper
{
  static std::vector<vtkMapper*> solids(vtkOpenGLMoleculeMapper* mapper)
  {
    (mapper->*(&MoleculeMapperAccess::UpdateGlyphPolyData))();
    std::vector<vtkMapper*> mappers;
    if (mapper->GetRenderAtoms())
    {
      mappers.push_back((mapper->*(&MoleculeMapperAccess::FastAtomMapper)).Get());
    }
    if (mapper->GetRenderBonds())
    {
      mappers.push_back((mapper->*(&MoleculeMapperAccess::FastBondMapper)).Get());
    }
    return mappers;
  }
};

/// Return a point array that VTK reads as floats without looking at its type; null for other
/// arrays.
vtkFloatArray* floatsOf(vtkPolyData* data, const char* name, int components)
{
  vtkDataArray* array = name ? data->GetPointData()->GetArray(name) : nullptr;
  const bool fits = array && array->GetNumberOfComponents() == components &&
    array->GetNumberOfTuples() == data->GetNumberOfPoints();
  return fits ? vtkFloatArray::SafeDownCast(array) : nullptr;
}

struct DataSetMapperAccess : vtkDataSetMapper
{
  /// Return the inner mapper, prepared as by vtkDataSetMapper::Render(), without colours and
  /// planes.
  static vtkPolyDataMapper* inner(vtkDataSetMapper* mapper)
  {
    vtkPolyDataMapper*& inner = mapper->*(&DataSetMapperAccess::PolyDataMapper);
    auto*& surface = mapper->*(&DataSetMapperAccess::GeometryExtractor);
    if (!inner)
    {
      inner = vtkPolyDataMapper::New();
      // vtkDataSetSurfaceFilter, in later releases vtkGeometryFilter
      surface = std::remove_reference_t<decltype(*surface)>::New();
    }
    vtkDataSet* input = mapper->GetInput();
    if (input->GetDataObjectType() == VTK_POLY_DATA)
    {
      inner->SetInputConnection(mapper->GetInputConnection(0, 0));
    }
    else
    {
      surface->SetInputData(input);
      inner->SetInputConnection(surface->GetOutputPort());
    }
    return inner;
  }
};

} // namespace

std::optional<SurfaceCells> cellsAboutToBeDrawn(vtkAbstractMapper* mapper)
{
  auto* openGl = vtkOpenGLPolyDataMapper::SafeDownCast(mapper);
  return openGl ? MapperAccess::cells(openGl) : std::nullopt;
}

std::vector<DrawCall> drawCalls(vtkAbstractMapper* mapper, SurfaceCells cells)
{
  const int primitiveType = cells == SurfaceCells::Polygons ? vtkOpenGLPolyDataMapper::PrimitiveTris
    : cells == SurfaceCells::PointSpheres ? vtkOpenGLPolyDataMapper::PrimitivePoints
    : cells == SurfaceCells::LineTubes    ? vtkOpenGLPolyDataMapper::PrimitiveLines
                                          : vtkOpenGLPolyDataMapper::PrimitiveTriStrips;
  if (auto calls = blockDrawCalls(mapper, primitiveType))
  {
    return *std::move(calls);
  }
  std::vector<DrawCall> calls;
  if (auto* openGl = vtkOpenGLPolyDataMapper::SafeDownCast(mapper))
  {
    // The current input, since a glyph mapper's helper has no other.
    calls.push_back(
      { openGl->CurrentInput, static_cast<std::uint32_t>(MapperAccess::primitiveOffset(openGl)) });
  }
  return calls;
}

vtkPolyDataMapper* innerMapper(vtkDataSetMapper* mapper)
{
  return DataSetMapperAccess::inner(mapper);
}

std::optional<DrawnSolids> drawnSolids(vtkMapper* mapper)
{
  if (auto* spheres = vtkOpenGLSphereMapper::SafeDownCast(mapper))
  {
    const char* scales = SphereMapperAccess::scales(spheres);
    vtkPolyData* data = spheres->GetInput();
    const bool hasScales = scales && data->GetPointData()->HasArray(scales);
    const DrawnSolids drawn{ SurfaceCells::Spheres, SphereMapperAccess::radius(spheres),
      floatsOf(data, scales, 1) };
    return drawn.scales || !hasScales ? std::optional(drawn) : std::nullopt;
  }
  if (auto* sticks = vtkOpenGLStickMapper::SafeDownCast(mapper))
  {
    vtkPolyData* data = sticks->GetInput();
    const DrawnSolids drawn{ SurfaceCells::Sticks, 0.0f,
      floatsOf(data, StickMapperAccess::scales(sticks), 3),
      floatsOf(data, StickMapperAccess::directions(sticks), 3) };
    return drawn.scales && drawn.directions ? std::optional(drawn) : std::nullopt;
  }
  return std::nullopt;
}

std::vector<vtkMapper*> solidMappers(vtkOpenGLMoleculeMapper* mapper)
{
  return MoleculeMapperAccess::solids(mapper);
}

const char* coordinatesArray(vtkAbstractMapper* mapper, const std::string& texture)
{
  // Helpers that draw the blocks of composite data do not receive these arrays.
  auto* openGl = vtkOpenGLPolyDataMapper::SafeDownCast(mapper);
  return openGl && blockDrawing(openGl) == BlockDrawing::None
    ? MapperAccess::coordinatesArray(openGl, texture)
    : nullptr;
}

} // namespace gnomon
