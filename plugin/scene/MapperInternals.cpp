#include "plugin/scene/MapperInternals.h"

// vtkCompositeMapperHelper2.h does not include these two, which it needs.
#include "vtkColor.h"
#include <vtk_glew.h>

#include "vtkCompositeMapperHelper2.h"
#include "vtkDataSet.h"
#include "vtkDataSetMapper.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkOpenGLCellToVTKCellMap.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLPolyDataMapper.h"

#include <algorithm>
#include <map>

namespace gnomon
{
namespace
{

// VTK tells a render pass neither which primitives a program draws nor where their numbers start,
// and the numbers depend on what happened before: a mapper that has cell colours or was picked
// counts polygon triangles exactly, else it takes one triangle per corner less two, skipped ones
// included. So the mapper's own members are read. Naming them through a subclass gives access to
// them without a cast.
struct MapperAccess : vtkOpenGLPolyDataMapper
{
  static std::optional<SurfaceCells> cells(vtkOpenGLPolyDataMapper* mapper)
  {
    const vtkOpenGLHelper* drawing = mapper->*(&MapperAccess::LastBoundBO);
    const auto& primitives = mapper->*(&MapperAccess::Primitives);
    if (drawing == &primitives[PrimitiveTris])
    {
      return SurfaceCells::Polygons;
    }
    if (drawing == &primitives[PrimitiveTriStrips])
    {
      return SurfaceCells::Strips;
    }
    return std::nullopt;
  }
  static int primitiveOffset(vtkOpenGLPolyDataMapper* mapper)
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

struct HelperAccess : vtkCompositeMapperHelper2
{
  using Blocks = std::map<vtkPolyData*, vtkCompositeMapperHelperData*>;
  static const Blocks& blocks(vtkCompositeMapperHelper2* helper)
  {
    return helper->*(&HelperAccess::Data);
  }
};

struct DataSetMapperAccess : vtkDataSetMapper
{
  /// What vtkDataSetMapper::Render() does before the inner mapper is told of colours and planes.
  static vtkPolyDataMapper* inner(vtkDataSetMapper* mapper)
  {
    vtkPolyDataMapper*& inner = mapper->*(&DataSetMapperAccess::PolyDataMapper);
    vtkDataSetSurfaceFilter*& surface = mapper->*(&DataSetMapperAccess::GeometryExtractor);
    if (!inner)
    {
      inner = vtkPolyDataMapper::New();
      surface = vtkDataSetSurfaceFilter::New();
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

//------------------------------------------------------------------------------
std::optional<SurfaceCells> cellsAboutToBeDrawn(vtkAbstractMapper* mapper)
{
  auto* openGl = vtkOpenGLPolyDataMapper::SafeDownCast(mapper);
  return openGl ? MapperAccess::cells(openGl) : std::nullopt;
}

//------------------------------------------------------------------------------
std::vector<DrawCall> drawCalls(vtkAbstractMapper* mapper, SurfaceCells cells)
{
  std::vector<DrawCall> calls;
  if (auto* helper = vtkCompositeMapperHelper2::SafeDownCast(mapper))
  {
    // A helper draws block by block, each with its own offset.
    const int primitives = cells == SurfaceCells::Polygons
      ? vtkOpenGLPolyDataMapper::PrimitiveTris
      : vtkOpenGLPolyDataMapper::PrimitiveTriStrips;
    for (const auto& [data, block] : HelperAccess::blocks(helper))
    {
      const vtkIdType offset = block->CellCellMap->GetPrimitiveOffsets()[primitives];
      calls.push_back({ data, static_cast<std::uint32_t>(offset) });
    }
  }
  else if (auto* openGl = vtkOpenGLPolyDataMapper::SafeDownCast(mapper))
  {
    // The current input, since a glyph mapper's helper has no other.
    calls.push_back(
      { openGl->CurrentInput, static_cast<std::uint32_t>(MapperAccess::primitiveOffset(openGl)) });
  }
  return calls;
}

//------------------------------------------------------------------------------
vtkPolyDataMapper* innerMapper(vtkDataSetMapper* mapper)
{
  return DataSetMapperAccess::inner(mapper);
}

//------------------------------------------------------------------------------
const char* coordinatesArray(vtkAbstractMapper* mapper, const std::string& texture)
{
  // The helpers of composite mappers are not told of such arrays.
  auto* openGl = vtkOpenGLPolyDataMapper::SafeDownCast(mapper);
  return openGl && !openGl->IsA("vtkCompositePolyDataMapper2")
    ? MapperAccess::coordinatesArray(openGl, texture)
    : nullptr;
}

} // namespace gnomon
