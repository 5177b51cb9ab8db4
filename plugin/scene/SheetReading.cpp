#include "plugin/scene/SheetReading.h"

#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/SolidSizes.h"
#include "plugin/scene/SurfaceRecord.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "plugin/vtk_versions/CompositeMappers.h"
#include "shadowtech/base/Occluders.h"

#include "vtkActor.h"
#include "vtkDataSet.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon
{
namespace
{

/// True if scalars may colour a mapper's glyphs.
bool mayColourGlyphs(vtkMapper* mapper)
{
  auto* const data = vtkDataSet::SafeDownCast(mapper->GetInputDataObject(0, 0));
  int cellFlag = 0;
  return !data ||
    vtkAbstractMapper::GetScalars(data, mapper->GetScalarMode(), mapper->GetArrayAccessMode(),
      mapper->GetArrayId(), mapper->GetArrayName(), cellFlag);
}

/// Return the mapped scalars of a block, four components each; null if VTK shows none, as of
/// glyphs' sources.
/// @param isOfCells set to true if they are the cells'
vtkUnsignedCharArray* mappedColours(vtkMapper* mapper, vtkPolyData* data, bool& isOfCells)
{
  int cellFlag = 0;
  vtkUnsignedCharArray* const colours =
    mapper->GetScalarVisibility() && !mapper->IsA("vtkGlyph3DMapper")
    ? mapper->MapScalars(data, 1.0, cellFlag)
    : nullptr;
  isOfCells = cellFlag == 1;
  return colours && colours->GetNumberOfComponents() == 4 && cellFlag <= 1 ? colours : nullptr;
}

glm::u8vec4 colourOf(vtkUnsignedCharArray* colours, vtkIdType tuple)
{
  const unsigned char* const rgba = colours->GetPointer(4 * tuple);
  return { rgba[0], rgba[1], rgba[2], rgba[3] };
}

/// Return the cell of each of a surface's triangles, as VTK numbers a polydata's cells.
std::vector<vtkIdType> cellsOfTriangles(
  vtkPolyData* data, const Surface& surface, SurfaceCells cells)
{
  std::vector<std::uint32_t> vertexOfPoint, cellOfDrawn;
  triangulate(data, cells, vertexOfPoint, &cellOfDrawn);
  const vtkIdType first = data->GetNumberOfVerts() + data->GetNumberOfLines() +
    (cells == SurfaceCells::Strips ? data->GetNumberOfPolys() : 0);
  std::vector<vtkIdType> cellOf(surface.triangleCount);
  for (std::uint32_t drawn = 0; drawn < cellOfDrawn.size(); ++drawn)
  {
    const std::uint32_t triangle =
      surface.triangleOfDrawn.empty() ? drawn : surface.triangleOfDrawn[drawn];
    if (triangle != Surface::noTriangle)
    {
      cellOf[triangle] = first + cellOfDrawn[drawn];
    }
  }
  return cellOf;
}

} // namespace

const char* whyNoSheet(const DrawnActor& drawn, const DrawnProp& prop)
{
  const MapperKind kind = drawn.kind;
  if (kind == MapperKind::Solids || kind == MapperKind::Molecule || kind == MapperKind::Splats ||
    isSizedInPixels(drawn.actor->GetProperty()))
  {
    return "it has spheres or tubes";
  }
  if (kind == MapperKind::Composite && mayBlocksDiffer(drawn.mapper))
  {
    return "its blocks may have opacities of their own";
  }
  if (prop.transmits == vtkGnomonPropKeys::TRANSMITS_COLORED &&
    (drawn.actor->GetTexture() || drawn.actor->GetProperty()->GetNumberOfTextures() > 0))
  {
    return "textures give it colours, which cannot be transmitted";
  }
  if (!drawn.mapper->GetScalarVisibility())
  {
    return nullptr;
  }
  if (kind == MapperKind::Glyphs)
  {
    return mayColourGlyphs(drawn.mapper) ? "scalars colour its glyphs" : nullptr;
  }
  return drawn.mapper->GetInterpolateScalarsBeforeMapping() ? "scalars interpolated before mapping"
    : !prop.clipPlanes.empty() ? "clipping planes cut surfaces that scalars colour"
                               : nullptr;
}

SheetSource sheetSource(const DrawnProp& prop, const DrawnBlock& block, const Surface& surface)
{
  if (prop.transmits == vtkGnomonPropKeys::TRANSMITS_NOTHING)
  {
    return {};
  }
  return { prop.transmits, prop.number, surface.topologyVersion,
    prop.actor->GetProperty()->GetMTime(),
    std::max(prop.mapper->GetMTime(), block.data->GetMTime()) };
}

std::shared_ptr<const Sheet> readSheet(const DrawnProp& prop, const DrawnBlock& block,
  const Surface& surface, const SurfaceRecord& record)
{
  Sheet sheet;
  sheet.prop = static_cast<std::uint32_t>(prop.number);
  sheet.isColoured = prop.transmits == vtkGnomonPropKeys::TRANSMITS_COLORED;
  vtkProperty* const property = prop.actor->GetProperty();
  const double* const colour = property->GetDiffuseColor();
  sheet.colour = { colour[0], colour[1], colour[2], property->GetOpacity() };
  if (prop.mapper->IsA("vtkGlyph3DMapper"))
  {
    sheet.colour.a *= sheet.colour.a; // VTK multiplies by the opacity twice
  }
  bool isOfCells = false;
  vtkUnsignedCharArray* const colours = mappedColours(prop.mapper, block.data, isOfCells);
  if (colours && isOfCells)
  {
    for (const vtkIdType cell : cellsOfTriangles(block.data, surface, record.key.cells))
    {
      sheet.ofTriangles.push_back(colourOf(colours, cell));
    }
  }
  else if (colours)
  {
    for (std::uint32_t vertex = 0; vertex < surface.vertexCount; ++vertex)
    {
      sheet.ofVertices.push_back(
        colourOf(colours, record.pointOfVertex.empty() ? vertex : record.pointOfVertex[vertex]));
    }
  }
  return std::make_shared<const Sheet>(std::move(sheet));
}

} // namespace gnomon
