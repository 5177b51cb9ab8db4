#pragma once

#include "lights/SceneFrame.h"
#include "lights/vtkGnomonVersions.h"
#include "shadowtech/base/Solid.h"

#include "vtkType.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Kinds of cells that VTK draws as surfaces. Each kind has its own range of primitive numbers, and
/// becomes its own surface in the snapshot.
enum class SurfaceCells
{
  Polygons,
  Strips,
  Spheres,      ///< one at each point; cells do not count
  Sticks,       ///< likewise
  PointSpheres, ///< one at each point of the vertex cells, sized in pixels
  LineTubes     ///< one along each part of a line, likewise
};

/// True if the camera determines their size.
inline bool areSizedInPixels(SurfaceCells cells)
{
  return cells == SurfaceCells::PointSpheres || cells == SurfaceCells::LineTubes;
}

/// Return the solid that VTK draws at the points of a kind; none if cells are drawn as triangles.
Solid solidOf(SurfaceCells cells);

/// Return the number of cells of a kind, or of solids.
vtkIdType cellCount(vtkPolyData* data, SurfaceCells cells);

/// Return the identity of the points and the cells of a kind. A shallow copy has the same.
std::pair<const void*, const void*> identityOf(vtkPolyData* data, SurfaceCells cells);

/// Return when the points or the cells last changed. Unlike vtkPolyData::GetMTime() it excludes
/// point and cell data, as new colours do not change the shape. For spheres and sticks it includes
/// them, since arrays hold their sizes.
vtkMTimeType shapeTime(vtkPolyData* data, SurfaceCells cells);

/// The triangles that VTK draws of a polydata, in its order. Polygons are fanned from their first
/// vertex, and every other triangle of a strip is reversed. Polygon triangles with two equal
/// vertices are left out (as in vtkOpenGLIndexBufferObject).
struct DrawnTriangles
{
  std::vector<glm::uvec3> triangles; ///< vertex numbers; `missingVertex` for a missing point
  std::uint32_t vertexCount = 0;
  /// The point of each vertex, in order of first use. Empty if every point is used and vertex n is
  /// point n.
  std::vector<std::uint32_t> pointOfVertex;
  Bounds boundsModel;  ///< box around the vertices with data, in model coordinates
  bool hasFar = false; ///< the matrix takes a finite vertex beyond largestOfWorld

  static constexpr std::uint32_t missingVertex = 0xffffffffu;
};

/// Return the triangles that VTK draws of a polydata's cells of a kind.
/// @param vertexOfPoint scratch memory, the same for many calls: blocks of one data set may share a
/// large point array, and this saves each of them the cost of all of it
/// @param cellOfTriangle if not null, receives each triangle's cell, counted among its kind
/// @param worldFromModel determines which vertices have data
DrawnTriangles triangulate(vtkPolyData* data, SurfaceCells cells,
  std::vector<std::uint32_t>& vertexOfPoint, std::vector<std::uint32_t>* cellOfTriangle = nullptr,
  const glm::dmat4& worldFromModel = glm::dmat4(1.0));

/// Why the snapshot leaves out a drawn triangle.
enum class Defect : std::uint8_t
{
  None,
  NonFinite, ///< a vertex is missing, or not within largestOfWorld
  ZeroArea   ///< its vertices are collinear
};

/// A drawn triangle that the snapshot leaves out.
struct DroppedTriangle
{
  glm::uvec3 vertices;
  Defect defect;

  bool operator==(const DroppedTriangle& other) const
  {
    return this->vertices == other.vertices && this->defect == other.defect;
  }
};

/// Write the centred positions of a surface's vertices, computed in double precision and rounded
/// once to float. NaN for points that are not within largestOfWorld.
void placeVertices(vtkPolyData* data, const std::vector<std::uint32_t>& pointOfVertex,
  std::size_t vertexCount, const glm::dmat4& worldFromModel, const SceneFrame& frame,
  glm::vec3* positionsCentred);

/// Return a surface's texture coordinates, one for each of its vertices. As in VTK's vertex shader,
/// they are transform * (s, t, 0, 1) divided by its last component, in float. The array has one or
/// two components. Missing and non-finite values become 0.
std::vector<glm::vec2> readTextureCoordinates(vtkDataArray* array, const glm::mat4& transform,
  const std::vector<std::uint32_t>& pointOfVertex, std::size_t vertexCount);

/// Return a surface's normals, one for each of its vertices, in model coordinates; none if the
/// array has too few.
std::vector<glm::vec3> readNormals(
  vtkDataArray* array, const std::vector<std::uint32_t>& pointOfVertex, std::size_t vertexCount);

/// Return the defect of a triangle at these positions.
Defect defectOf(const glm::uvec3& triangle, const glm::vec3* positionsCentred);

/// Set non-finite vertices to zero. No triangle of the snapshot refers to them; this keeps NaN out
/// of buffers and boxes.
void clearNonFinite(glm::vec3* positionsCentred, std::size_t vertexCount);

} // namespace gnomon
