#include "plugin/scene/SurfaceRecord.h"

#include "plugin/scene/GlyphInstances.h"
#include "plugin/scene/PlacedSolids.h"
#include "plugin/scene/SplatSpheres.h"
#include "plugin/scene/SurfaceClipping.h"

#include "shadowtech/base/Instances.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/SmoothFacet.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gnomon
{
namespace
{

std::vector<glm::vec2> repeated(const std::vector<glm::vec2>& numbers, std::size_t times)
{
  std::vector<glm::vec2> result;
  result.reserve(numbers.size() * times);
  for (std::size_t i = 0; i < times; ++i)
  {
    result.insert(result.end(), numbers.begin(), numbers.end());
  }
  return result;
}

/// Return the normals turned by each of the matrices.
std::vector<glm::vec3> turned(
  const std::vector<glm::vec3>& normals, const std::vector<glm::mat4>& matrices)
{
  std::vector<glm::vec3> result;
  result.reserve(normals.size() * matrices.size());
  for (const glm::mat4& matrix : matrices)
  {
    const glm::dmat3 turn = normalMatrix(glm::dmat3(matrix));
    for (const glm::vec3& normal : normals)
    {
      result.emplace_back(turn * glm::dvec3(normal));
    }
  }
  return result;
}

/// Return the largest height of a polydata's facets, in its own coordinates.
float facetHeight(vtkPolyData* data, const DrawnTriangles& drawn,
  const std::vector<glm::vec3>& normals, const std::vector<std::uint32_t>& pointOfVertex)
{
  if (normals.empty() || drawn.triangles.size() > mostFacets)
  {
    return 0.0f;
  }
  std::vector<glm::vec3> positions(drawn.vertexCount);
  placeVertices(
    data, pointOfVertex, positions.size(), glm::dmat4(1.0), SceneFrame(), positions.data());
  return largestHeightOf(positions, drawn.triangles, normals);
}

/// Repeat a glyph's triangles for each of its instances, each with its own vertices and texture
/// coordinates. Too many triangles become none.
void expandInstances(FreshSurface& fresh)
{
  std::vector<glm::uvec3>& triangles = fresh.triangles;
  const std::size_t count = triangles.size();
  const std::size_t instances = fresh.record.modelFromInstance.size();
  if (fresh.record.tooManyTriangles)
  {
    triangles.clear();
    fresh.textureCoordinates.clear();
    fresh.pointNormals.clear();
    fresh.vertexCount = 0;
    return;
  }
  triangles.reserve(count * instances);
  for (std::size_t instance = 1; instance < instances; ++instance)
  {
    const auto shift = static_cast<std::uint32_t>(instance * fresh.vertexCount);
    for (std::size_t i = 0; i < count; ++i)
    {
      const glm::uvec3 triangle = triangles[i];
      const bool missing = triangle.x == DrawnTriangles::missingVertex;
      triangles.push_back(missing ? triangle : triangle + shift);
    }
  }
  triangles.resize(count * instances);
  fresh.textureCoordinates = repeated(fresh.textureCoordinates, instances);
  fresh.pointNormals = turned(fresh.pointNormals, fresh.record.modelFromInstance);
}

/// Remove the triangles that have a defect from a fresh surface.
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

/// Compute the source and the instances of a surface; false if it cannot be held as instances.
bool placeSource(FreshSurface& fresh, const DrawnBlock& block, const SceneFrame& frame)
{
  SurfaceRecord& record = fresh.record;
  std::optional<PlacedInstances> placed = placeKeptInstances(record, block, frame);
  if (!placed)
  {
    return false;
  }
  fresh.instances = std::move(*placed);
  fresh.positionsCentred.resize(fresh.vertexCount);
  glm::vec3* positions = fresh.positionsCentred.data();
  placeVertices(
    block.data, record.pointOfVertex, fresh.vertexCount, glm::dmat4(1.0), record.source, positions);
  dropDefects(fresh);
  clearNonFinite(positions, fresh.vertexCount);
  recordPlaces(fresh.instances, positions, fresh.vertexCount, record);
  record.keptAsInstances = true;
  return true;
}

/// Return the mesh of solids, and the box around them before their actor's matrix.
FreshSurface readSolids(const DrawnBlock& block, SurfaceCells cells)
{
  const auto count = static_cast<std::size_t>(cellCount(block.data, cells));
  SolidMesh mesh = meshOf(solidOf(cells), count);
  FreshSurface fresh;
  fresh.vertexCount = mesh.positions.size();
  fresh.positionsCentred = std::move(mesh.positions);
  fresh.triangles = std::move(mesh.triangles);
  fresh.record.keptAsInstances = true;
  fresh.record.boundsModel = boundsOfSolids(block, cells);
  return fresh;
}

} // namespace

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

vtkMTimeType changeTime(const DrawnProp& prop, const DrawnBlock& block, SurfaceCells cells)
{
  vtkMTimeType time = shapeTime(block.data, cells);
  if (block.solids)
  {
    time = std::max(time, sizesTime(block.solids));
  }
  if (block.glyphPoints)
  {
    // The time at which VTK recomputes the instances.
    auto* mapper = static_cast<vtkGlyph3DMapper*>(prop.mapper);
    vtkObject* attributes = mapper->GetBlockAttributes();
    time = std::max({ time, mapper->GetMTime(), block.glyphPoints->GetMTime(),
      attributes ? attributes->GetMTime() : 0 });
  }
  return time;
}

bool reachesBeyondWorld(const SurfaceRecord& record, const DrawnProp& prop)
{
  const Bounds box = transformed(record.boundsModel, prop.worldFromModel);
  return record.hasFar || (!record.boundsModel.empty() && !isWithin(box, largestOfWorld));
}

bool isWhere(const SurfaceRecord& record, const DrawnProp& prop, const DrawnBlock& block)
{
  return record.worldFromModel == prop.worldFromModel &&
    record.radiusFromWorld == radiusFromWorld(block, record.key.cells);
}

CoordinatesSource coordinatesSource(const DrawnProp& prop, const DrawnBlock& block)
{
  vtkDataArray* array = block.textureCoordinates;
  return array ? CoordinatesSource{ array, array->GetMTime(), prop.textureTransform }
               : CoordinatesSource{};
}

NormalsSource normalsSource(const DrawnProp& prop, const DrawnBlock& block)
{
  // Clipping makes other vertices.
  vtkDataArray* array = prop.receives && prop.clipPlanes.empty() ? block.normals : nullptr;
  return array ? NormalsSource{ array, array->GetMTime() } : NormalsSource{};
}

FreshSurface readSurface(const DrawnProp& prop, const DrawnBlock& block, SurfaceCells cells,
  std::vector<std::uint32_t>& vertexOfPoint)
{
  if (solidOf(cells) != Solid::None)
  {
    return readSolids(block, cells);
  }
  DrawnTriangles drawn =
    triangulate(block.data, cells, vertexOfPoint, nullptr, prop.worldFromModel);
  FreshSurface fresh;
  SurfaceRecord& record = fresh.record;
  record.pointOfVertex = std::move(drawn.pointOfVertex);
  record.boundsModel = drawn.boundsModel;
  record.hasFar = drawn.hasFar;
  if (block.glyphPoints)
  {
    record.modelFromInstance = glyphInstances(
      static_cast<vtkGlyph3DMapper*>(prop.mapper), block.glyphPoints, block.glyphSource);
    record.boundsModel = Bounds();
    for (const glm::mat4& instance : record.modelFromInstance)
    {
      const Bounds box = transformed(drawn.boundsModel, glm::dmat4(instance));
      const bool isFar = !isWithin(transformed(box, prop.worldFromModel), largestOfWorld);
      record.hasFar = record.hasFar || isFar;
      record.boundsModel.add(isFar ? Bounds() : box);
    }
    const std::size_t instances = record.modelFromInstance.size();
    record.tooManyTriangles = drawn.triangles.size() * instances > mostGlyphTriangles;
    record.instancesOfAll = instances;
    if (!record.tooManyTriangles && prop.clipPlanes.empty() && !drawn.boundsModel.empty())
    {
      record.trianglesOfSource = drawn.triangles.size();
      record.source = sceneFrameOf(drawn.boundsModel);
      // Of a source, nothing moves: it is centred without a grid.
      record.source.centre = drawn.boundsModel.centre() * record.source.unitsPerWorld();
      record.boundsSource = { record.source.fromWorld(drawn.boundsModel.lower),
        record.source.fromWorld(drawn.boundsModel.upper) };
    }
  }
  record.coordinates = coordinatesSource(prop, block);
  if (record.coordinates.get().array)
  {
    fresh.textureCoordinates = readTextureCoordinates(
      block.textureCoordinates, prop.textureTransform, record.pointOfVertex, drawn.vertexCount);
  }
  record.normals = normalsSource(prop, block);
  if (record.normals.array)
  {
    fresh.pointNormals = readNormals(block.normals, record.pointOfVertex, drawn.vertexCount);
    record.facetHeight = facetHeight(block.data, drawn, fresh.pointNormals, record.pointOfVertex);
  }
  fresh.vertexCount = drawn.vertexCount;
  fresh.triangles = std::move(drawn.triangles);
  return fresh;
}

std::optional<PlacedInstances> placeKeptInstances(
  const SurfaceRecord& record, const DrawnBlock& block, const SceneFrame& frame)
{
  if (solidOf(record.key.cells) != Solid::None)
  {
    return placeSolids(block, record.key.cells, record.worldFromModel, record.clipPlanes, frame);
  }
  return placeKeptInstances(
    record.worldFromModel, record.modelFromInstance, record.source, record.boundsSource, frame);
}

void recordPlaces(const PlacedInstances& placed, const glm::vec3* positionsSource,
  std::size_t vertexCount, SurfaceRecord& record)
{
  record.leftOutNonFinite = placed.leftOutNonFinite;
  record.leftOutVanished = placed.leftOutVanished;
  if (const Solid solid = solidOf(record.key.cells); solid != Solid::None)
  {
    record.boundsCentred = solidsBounds(solid, placed.centredFromSource);
    return;
  }
  record.boundsCentred = instancesBounds(positionsSource, vertexCount, placed.centredFromSource);
}

void placeInstances(const DrawnBlock& block, const SurfaceRecord& record, std::size_t vertexCount,
  const SceneFrame& frame, glm::vec3* positionsCentred)
{
  const std::size_t instances = record.modelFromInstance.size();
  const std::size_t step = instances > 0 ? vertexCount / instances : 0;
  for (std::size_t i = 0; i < instances; ++i)
  {
    placeVertices(block.data, record.pointOfVertex, step,
      record.worldFromModel * glm::dmat4(record.modelFromInstance[i]), frame,
      positionsCentred + i * step);
  }
}

void placeSurface(
  FreshSurface& fresh, const DrawnProp& prop, const DrawnBlock& block, const SceneFrame& frame)
{
  SurfaceRecord& record = fresh.record;
  record.worldFromModel = prop.worldFromModel;
  record.clipPlanes = prop.clipPlanes;
  std::vector<glm::vec3>& positions = fresh.positionsCentred;
  record.radiusFromWorld = radiusFromWorld(block, record.key.cells);
  if (solidOf(record.key.cells) != Solid::None)
  {
    fresh.instances = *placeKeptInstances(record, block, frame);
    recordPlaces(fresh.instances, positions.data(), positions.size(), record);
    return;
  }
  if (areInstancesCheaper(record.trianglesOfSource, record.instancesOfAll) &&
    placeSource(fresh, block, frame))
  {
    return;
  }
  if (block.glyphPoints)
  {
    expandInstances(fresh);
  }
  positions.resize(fresh.vertexCount * record.modelFromInstance.size());
  placeInstances(block, record, positions.size(), frame, positions.data());
  dropDefects(fresh);
  clearNonFinite(positions.data(), positions.size());
  if (!record.clipPlanes.empty())
  {
    std::vector<glm::dvec4> planesCentred = record.clipPlanes;
    for (glm::dvec4& plane : planesCentred)
    {
      plane.w = plane.w * frame.unitsPerWorld() + glm::dot(glm::dvec3(plane), frame.centre);
    }
    clipTriangles(
      planesCentred, positions, fresh.textureCoordinates, fresh.triangles, fresh.triangleOfDrawn);
  }
  record.boundsCentred = boundsOf(fresh.triangles.begin(), fresh.triangles.end(), positions.data());
}

} // namespace gnomon
