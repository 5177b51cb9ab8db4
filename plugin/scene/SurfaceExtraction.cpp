#include "plugin/scene/SurfaceExtraction.h"

#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

vtkCellArray* cellArray(vtkPolyData* data, SurfaceCells cells)
{
  return cells == SurfaceCells::Polygons ? data->GetPolys()
    : cells == SurfaceCells::Strips      ? data->GetStrips()
    : cells == SurfaceCells::LineTubes   ? data->GetLines()
                                         : data->GetVerts();
}

bool finite(const glm::vec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Call worker(array) with the points' real type if that is float or double, in any memory layout.
/// Other arrays are read through vtkDataArray, as doubles.
template <typename Worker>
void withPoints(vtkDataArray* points, Worker& worker)
{
  using Dispatcher = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>;
  if (!Dispatcher::Execute(points, worker))
  {
    worker(points);
  }
}

/// Lists drawn triangles as point numbers.
struct Triangulator
{
  vtkCellArray* cells;
  SurfaceCells kind;
  std::vector<glm::uvec3>& triangles;
  std::vector<std::uint32_t>* cellOfTriangle;

  template <typename PointArray>
  void operator()(PointArray* array)
  {
    const auto points = vtk::DataArrayTupleRange<3>(array);
    const vtkIdType pointCount = points.size();
    const auto drawn = [&](vtkIdType a, vtkIdType b, vtkIdType c)
    {
      const auto present = [pointCount](vtkIdType id) { return id >= 0 && id < pointCount; };
      if (!present(a) || !present(b) || !present(c))
      {
        this->triangles.emplace_back(DrawnTriangles::missingVertex);
      }
      // Compared in the array's own type, where NaN differs from itself, as in VTK.
      else if (this->kind == SurfaceCells::Strips ||
        (points[a] != points[b] && points[a] != points[c] && points[b] != points[c]))
      {
        this->triangles.emplace_back(a, b, c);
      }
    };

    const auto iterator = vtk::TakeSmartPointer(this->cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      vtkIdType size;
      const vtkIdType* ids;
      iterator->GetCurrentCell(size, ids);
      for (vtkIdType i = 0; i + 2 < size; ++i)
      {
        if (this->kind == SurfaceCells::Polygons)
        {
          drawn(ids[0], ids[i + 1], ids[i + 2]);
        }
        else
        {
          drawn(ids[i], ids[i + 1 + i % 2], ids[i + 1 + (i + 1) % 2]);
        }
      }
      if (this->cellOfTriangle)
      {
        this->cellOfTriangle->resize(
          this->triangles.size(), static_cast<std::uint32_t>(iterator->GetCurrentCellId()));
      }
    }
  }
};

/// Calls visit(vertex, position) with every vertex's position in model coordinates.
template <typename Visit>
struct VertexReader
{
  const std::vector<std::uint32_t>& pointOfVertex;
  std::size_t vertexCount;
  Visit visit;

  template <typename PointArray>
  void operator()(PointArray* array)
  {
    const auto points = vtk::DataArrayTupleRange<3>(array);
    for (std::size_t vertex = 0; vertex < this->vertexCount; ++vertex)
    {
      const auto point = points[static_cast<vtkIdType>(
        this->pointOfVertex.empty() ? vertex : this->pointOfVertex[vertex])];
      this->visit(vertex,
        glm::dvec3(static_cast<double>(point[0]), static_cast<double>(point[1]),
          static_cast<double>(point[2])));
    }
  }
};

template <typename Visit>
void readVertices(vtkPolyData* data, const std::vector<std::uint32_t>& pointOfVertex,
  std::size_t vertexCount, Visit visit)
{
  VertexReader<Visit> reader{ pointOfVertex, vertexCount, visit };
  withPoints(data->GetPoints()->GetData(), reader);
}

/// Return a point's place in the world; NaN if it is missing data.
glm::dvec3 inWorld(const glm::dmat4& worldFromModel, const glm::dvec3& position)
{
  // w differs from 1 only for a projective user matrix. With w = 0 the vertex is not finite.
  const glm::dvec4 world = worldFromModel * glm::dvec4(position, 1.0);
  const glm::dvec3 place = glm::dvec3(world) / world.w;
  return isWithin(place, largestOfWorld) ? place
                                         : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
}

/// Renumber triangles from points to the vertices that they use. Between calls, all of
/// vertexOfPoint is missingVertex. Only the entries in use are set and reset.
void compact(
  DrawnTriangles& drawn, std::size_t pointCount, std::vector<std::uint32_t>& vertexOfPoint)
{
  if (vertexOfPoint.size() < pointCount)
  {
    vertexOfPoint.resize(pointCount, DrawnTriangles::missingVertex);
  }

  std::vector<std::uint32_t>& pointOfVertex = drawn.pointOfVertex;
  for (const glm::uvec3& triangle : drawn.triangles)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::uint32_t point = triangle[corner];
      if (point != DrawnTriangles::missingVertex &&
        vertexOfPoint[point] == DrawnTriangles::missingVertex)
      {
        vertexOfPoint[point] = static_cast<std::uint32_t>(pointOfVertex.size());
        pointOfVertex.push_back(point);
      }
    }
  }
  drawn.vertexCount = static_cast<std::uint32_t>(pointOfVertex.size());

  const bool everyPointUsed = pointOfVertex.size() == pointCount;
  if (!everyPointUsed)
  {
    for (glm::uvec3& triangle : drawn.triangles)
    {
      if (triangle.x != DrawnTriangles::missingVertex)
      {
        triangle = { vertexOfPoint[triangle.x], vertexOfPoint[triangle.y],
          vertexOfPoint[triangle.z] };
      }
    }
  }
  for (const std::uint32_t point : pointOfVertex)
  {
    vertexOfPoint[point] = DrawnTriangles::missingVertex;
  }
  if (everyPointUsed)
  {
    pointOfVertex = {};
  }
  pointOfVertex.shrink_to_fit();
}

} // namespace

Solid solidOf(SurfaceCells cells)
{
  switch (cells)
  {
    case SurfaceCells::Spheres:
    case SurfaceCells::PointSpheres:
      return Solid::Sphere;
    case SurfaceCells::Sticks:
      return Solid::Cylinder;
    case SurfaceCells::LineTubes:
      return Solid::Tube;
    case SurfaceCells::Polygons:
    case SurfaceCells::Strips:
      break;
  }
  return Solid::None;
}

vtkIdType cellCount(vtkPolyData* data, SurfaceCells cells)
{
  if (!data->GetPoints())
  {
    return 0;
  }
  vtkCellArray* array = cellArray(data, cells);
  switch (cells)
  {
    case SurfaceCells::Spheres:
    case SurfaceCells::Sticks:
      return data->GetNumberOfPoints();
    case SurfaceCells::PointSpheres:
      return array->GetNumberOfConnectivityIds();
    case SurfaceCells::LineTubes:
      return std::max<vtkIdType>(
        0, array->GetNumberOfConnectivityIds() - array->GetNumberOfCells());
    case SurfaceCells::Polygons:
    case SurfaceCells::Strips:
      break;
  }
  return array->GetNumberOfCells();
}

std::pair<const void*, const void*> identityOf(vtkPolyData* data, SurfaceCells cells)
{
  const bool areCells = cells != SurfaceCells::Spheres && cells != SurfaceCells::Sticks;
  return { data->GetPoints(), areCells ? cellArray(data, cells) : nullptr };
}

vtkMTimeType shapeTime(vtkPolyData* data, SurfaceCells cells)
{
  if (cells == SurfaceCells::Spheres || cells == SurfaceCells::Sticks)
  {
    return data->GetMTime();
  }
  // The object's own time, which Modified() and every Set method raise. vtkPolyData's override adds
  // point and cell data.
  return std::max({ data->vtkObject::GetMTime(), data->GetPoints()->GetMTime(),
    data->GetPoints()->GetData()->GetMTime(), cellArray(data, cells)->GetMTime() });
}

DrawnTriangles triangulate(vtkPolyData* data, SurfaceCells cells,
  std::vector<std::uint32_t>& vertexOfPoint, std::vector<std::uint32_t>* cellOfTriangle,
  const glm::dmat4& worldFromModel)
{
  DrawnTriangles drawn;
  vtkCellArray* array = cellArray(data, cells);
  drawn.triangles.reserve(static_cast<std::size_t>(
    std::max<vtkIdType>(0, array->GetNumberOfConnectivityIds() - 2 * array->GetNumberOfCells())));
  Triangulator triangulator{ array, cells, drawn.triangles, cellOfTriangle };
  withPoints(data->GetPoints()->GetData(), triangulator);

  compact(drawn, static_cast<std::size_t>(data->GetNumberOfPoints()), vertexOfPoint);
  readVertices(data, drawn.pointOfVertex, drawn.vertexCount,
    [&](std::size_t, const glm::dvec3& position)
    {
      if (!std::isnan(inWorld(worldFromModel, position).x))
      {
        drawn.boundsModel.add(position);
        return;
      }
      drawn.hasFar = drawn.hasFar || isWithin(position, std::numeric_limits<double>::max());
    });
  return drawn;
}

void placeVertices(vtkPolyData* data, const std::vector<std::uint32_t>& pointOfVertex,
  std::size_t vertexCount, const glm::dmat4& worldFromModel, const SceneFrame& frame,
  glm::vec3* positionsCentred)
{
  const double unitsPerWorld = frame.unitsPerWorld();
  readVertices(data, pointOfVertex, vertexCount,
    [&](std::size_t vertex, const glm::dvec3& position)
    {
      positionsCentred[vertex] =
        glm::vec3(inWorld(worldFromModel, position) * unitsPerWorld - frame.centre);
    });
}

std::vector<glm::vec3> readNormals(
  vtkDataArray* array, const std::vector<std::uint32_t>& pointOfVertex, std::size_t vertexCount)
{
  std::vector<glm::vec3> normals(vertexCount);
  const auto* const floats = vtkFloatArray::FastDownCast(array);
  for (std::size_t vertex = 0; vertex < vertexCount; ++vertex)
  {
    const auto point =
      static_cast<vtkIdType>(pointOfVertex.empty() ? vertex : pointOfVertex[vertex]);
    if (point >= array->GetNumberOfTuples())
    {
      return {};
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      normals[vertex][axis] = floats ? floats->GetTypedComponent(point, axis)
                                     : static_cast<float>(array->GetComponent(point, axis));
    }
  }
  return normals;
}

std::vector<glm::vec2> readTextureCoordinates(vtkDataArray* array, const glm::mat4& transform,
  const std::vector<std::uint32_t>& pointOfVertex, std::size_t vertexCount)
{
  std::vector<glm::vec2> coordinates(vertexCount, glm::vec2(0.0f));
  const bool two = array->GetNumberOfComponents() > 1;
  for (std::size_t vertex = 0; vertex < vertexCount; ++vertex)
  {
    const auto point =
      static_cast<vtkIdType>(pointOfVertex.empty() ? vertex : pointOfVertex[vertex]);
    if (point < array->GetNumberOfTuples())
    {
      const auto s = static_cast<float>(array->GetComponent(point, 0));
      const auto t = static_cast<float>(two ? array->GetComponent(point, 1) : 0.0);
      const glm::vec4 transformed = transform * glm::vec4(s, t, 0.0f, 1.0f);
      const glm::vec2 result = glm::vec2(transformed) / transformed.w;
      // An array of one component keeps one component after the transformation, as in VTK.
      const glm::vec2 kept(result.x, two ? result.y : 0.0f);
      coordinates[vertex] = std::isfinite(kept.x) && std::isfinite(kept.y) ? kept : glm::vec2(0.0f);
    }
  }
  return coordinates;
}

Defect defectOf(const glm::uvec3& triangle, const glm::vec3* positionsCentred)
{
  if (triangle.x == DrawnTriangles::missingVertex)
  {
    return Defect::NonFinite;
  }
  const glm::vec3& a = positionsCentred[triangle.x];
  const glm::vec3& b = positionsCentred[triangle.y];
  const glm::vec3& c = positionsCentred[triangle.z];
  if (!finite(a) || !finite(b) || !finite(c))
  {
    return Defect::NonFinite;
  }
  const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a);
  const glm::dvec3 ac = glm::dvec3(c) - glm::dvec3(a);
  // On collinear points the computed cross product is not exactly 0. Its rounding error is below 2
  // epsilon |ab| |ac| per component.
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  const double area = glm::length(glm::cross(ab, ac));
  return area > rounding * glm::length(ab) * glm::length(ac) ? Defect::None : Defect::ZeroArea;
}

void clearNonFinite(glm::vec3* positionsCentred, std::size_t vertexCount)
{
  for (std::size_t vertex = 0; vertex < vertexCount; ++vertex)
  {
    if (!finite(positionsCentred[vertex]))
    {
      positionsCentred[vertex] = glm::vec3(0.0f);
    }
  }
}

} // namespace gnomon
