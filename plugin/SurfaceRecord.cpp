#include "plugin/SurfaceRecord.h"

#include "plugin/GlyphInstances.h"
#include "plugin/SurfaceClipping.h"

#include "shadowtech/base/Occluders.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gnomon
{
namespace
{

/// Repeats a glyph's triangles for each of its instances, each with vertices of its own.
void repeatTriangles(std::vector<glm::uvec3>& triangles, std::uint32_t vertexCount, std::size_t n)
{
  const std::size_t count = triangles.size();
  triangles.reserve(count * n);
  for (std::size_t instance = 1; instance < n; ++instance)
  {
    const auto shift = static_cast<std::uint32_t>(instance * vertexCount);
    for (std::size_t i = 0; i < count; ++i)
    {
      const glm::uvec3 triangle = triangles[i];
      const bool missing = triangle.x == DrawnTriangles::missingVertex;
      triangles.push_back(missing ? triangle : triangle + shift);
    }
  }
  triangles.resize(count * n);
}

/// Takes the triangles that have a defect out of a fresh surface.
void dropDefects(FreshSurface& fresh)
{
  const std::size_t drawnCount = fresh.triangles.size();
  std::uint32_t keptCount = 0;
  for (std::size_t drawn = 0; drawn < drawnCount; ++drawn)
  {
    const glm::uvec3 triangle = fresh.triangles[drawn];
    const Defect defect = defectOf(triangle, fresh.positionsCentred.data());
    if (defect != Defect::None)
    {
      if (fresh.triangleOfDrawn.empty())
      {
        fresh.triangleOfDrawn.resize(drawnCount);
        std::iota(fresh.triangleOfDrawn.begin(), fresh.triangleOfDrawn.end(), 0u);
      }
      fresh.triangleOfDrawn[drawn] = Surface::noTriangle;
      fresh.record.dropped.push_back({ triangle, defect });
      continue;
    }
    if (!fresh.triangleOfDrawn.empty())
    {
      fresh.triangleOfDrawn[drawn] = keptCount;
    }
    fresh.triangles[keptCount++] = triangle;
  }
  fresh.triangles.resize(keptCount);
}

} // namespace

//------------------------------------------------------------------------------
Bounds transformed(const Bounds& box, const glm::dmat4& matrix)
{
  Bounds result;
  if (!box.empty())
  {
    for (const glm::dvec3& corner : box.corners())
    {
      const glm::dvec4 image = matrix * glm::dvec4(corner, 1.0);
      result.add(glm::dvec3(image) / image.w);
    }
  }
  return result;
}

//------------------------------------------------------------------------------
vtkMTimeType changeTime(const DrawnProp& prop, const DrawnBlock& block, SurfaceCells cells)
{
  vtkMTimeType time = shapeTime(block.data, cells);
  if (block.glyphPoints)
  {
    // When VTK computes the instances again.
    auto* mapper = static_cast<vtkGlyph3DMapper*>(prop.mapper);
    vtkObject* attributes = mapper->GetBlockAttributes();
    time = std::max({ time, mapper->GetMTime(), block.glyphPoints->GetMTime(),
      attributes ? attributes->GetMTime() : 0 });
  }
  return time;
}

//------------------------------------------------------------------------------
CoordinatesSource coordinatesSource(const DrawnProp& prop, const DrawnBlock& block)
{
  vtkDataArray* array = block.textureCoordinates;
  return array ? CoordinatesSource{ array, array->GetMTime(), prop.textureTransform }
               : CoordinatesSource{};
}

//------------------------------------------------------------------------------
FreshSurface readSurface(const DrawnProp& prop, const DrawnBlock& block, SurfaceCells cells,
  std::size_t mostGlyphTriangles, std::vector<std::uint32_t>& vertexOfPoint)
{
  DrawnTriangles drawn = triangulate(block.data, cells, vertexOfPoint);
  FreshSurface fresh;
  SurfaceRecord& record = fresh.record;
  record.pointOfVertex = std::move(drawn.pointOfVertex);
  record.boundsModel = drawn.boundsModel;
  if (block.glyphPoints)
  {
    record.modelFromInstance = glyphInstances(
      static_cast<vtkGlyph3DMapper*>(prop.mapper), block.glyphPoints, block.glyphSource);
    const std::size_t instances = record.modelFromInstance.size();
    record.boundsModel = Bounds();
    for (const glm::mat4& instance : record.modelFromInstance)
    {
      record.boundsModel.add(transformed(drawn.boundsModel, glm::dmat4(instance)));
    }
    record.tooManyTriangles = drawn.triangles.size() * instances > mostGlyphTriangles;
    if (record.tooManyTriangles)
    {
      drawn.triangles.clear();
      drawn.vertexCount = 0;
    }
    repeatTriangles(drawn.triangles, drawn.vertexCount, instances);
  }
  record.coordinates = coordinatesSource(prop, block);
  if (record.coordinates.array)
  {
    const std::vector<glm::vec2> one = readTextureCoordinates(
      block.textureCoordinates, prop.textureTransform, record.pointOfVertex, drawn.vertexCount);
    for (std::size_t i = 0; i < record.modelFromInstance.size(); ++i)
    {
      fresh.textureCoordinates.insert(fresh.textureCoordinates.end(), one.begin(), one.end());
    }
  }
  fresh.positionsCentred.resize(drawn.vertexCount * record.modelFromInstance.size());
  fresh.triangles = std::move(drawn.triangles);
  return fresh;
}

//------------------------------------------------------------------------------
void placeInstances(const DrawnBlock& block, const SurfaceRecord& record, std::size_t vertexCount,
  const glm::dvec3& centreWorld, glm::vec3* positionsCentred)
{
  const std::size_t instances = record.modelFromInstance.size();
  const std::size_t step = instances > 0 ? vertexCount / instances : 0;
  for (std::size_t i = 0; i < instances; ++i)
  {
    placeVertices(block.data, record.pointOfVertex, step,
      record.worldFromModel * glm::dmat4(record.modelFromInstance[i]), centreWorld,
      positionsCentred + i * step);
  }
}

//------------------------------------------------------------------------------
void placeSurface(FreshSurface& fresh, const DrawnProp& prop, const DrawnBlock& block,
  const glm::dvec3& centreWorld)
{
  SurfaceRecord& record = fresh.record;
  record.worldFromModel = prop.worldFromModel;
  record.clipPlanes = prop.clipPlanes;
  std::vector<glm::vec3>& positions = fresh.positionsCentred;
  placeInstances(block, record, positions.size(), centreWorld, positions.data());
  dropDefects(fresh);
  clearNonFinite(positions.data(), positions.size());
  if (!record.clipPlanes.empty())
  {
    std::vector<glm::dvec4> planesCentred = record.clipPlanes;
    for (glm::dvec4& plane : planesCentred)
    {
      plane.w += glm::dot(glm::dvec3(plane), centreWorld);
    }
    clipTriangles(
      planesCentred, positions, fresh.textureCoordinates, fresh.triangles, fresh.triangleOfDrawn);
  }
  record.boundsCentred = boundsOf(fresh.triangles.begin(), fresh.triangles.end(), positions.data());
}

} // namespace gnomon
