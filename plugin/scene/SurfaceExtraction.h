#pragma once

#include "lights/Bounds.h"
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

/// What VTK draws of a polydata as surfaces. Each kind has a range of primitive numbers of its own,
/// and becomes a surface of its own in the snapshot.
enum class SurfaceCells
{
  Polygons,
  Strips,
  Spheres,      ///< one at each point; cells do not count
  Sticks,       ///< likewise
  PointSpheres, ///< one at each point of the vertex cells, sized in pixels
  LineTubes     ///< one along each part of a line, likewise
};

/// Whether the camera says how large they are.
inline bool areSizedInPixels(SurfaceCells cells)
{
  return cells == SurfaceCells::PointSpheres || cells == SurfaceCells::LineTubes;
}

/// What the points of a kind are drawn as; none where cells are drawn as triangles.
Solid solidOf(SurfaceCells cells);

/// The number of cells of a kind, or of solids.
vtkIdType cellCount(vtkPolyData* data, SurfaceCells cells);

/// Names the points and the cells of a kind: those of a shallow copy are the same.
std::pair<const void*, const void*> identityOf(vtkPolyData* data, SurfaceCells cells);

/// When the points or the cells last changed. Unlike vtkPolyData::GetMTime() it leaves out the
/// point and cell data: new colours are no new shape. Of spheres and sticks it does not,
/// since arrays hold their sizes.
vtkMTimeType shapeTime(vtkPolyData* data, SurfaceCells cells);

/// The triangles that VTK draws of a polydata, in its order: polygons fanned from their first
/// vertex, strips with every other triangle turned, polygon triangles with two equal vertices left
/// out (as vtkOpenGLIndexBufferObject builds them).
struct DrawnTriangles
{
  std::vector<glm::uvec3>
    triangles; ///< vertex numbers; `missingVertex` for a point that is not there
  std::uint32_t vertexCount = 0;
  /// The point of each vertex, in order of first use; empty when every point is used and vertex n
  /// is point n.
  std::vector<std::uint32_t> pointOfVertex;
  Bounds boundsModel; ///< box around the finite vertices, in model coordinates

  static constexpr std::uint32_t missingVertex = 0xffffffffu;
};

/// @param vertexOfPoint scratch memory, the same for many calls: blocks of one data set may share a
/// large point array, and none of them has to pay for all of it
/// @param cellOfTriangle where not null, becomes each triangle's cell, counted among its kind
DrawnTriangles triangulate(vtkPolyData* data, SurfaceCells cells,
  std::vector<std::uint32_t>& vertexOfPoint, std::vector<std::uint32_t>* cellOfTriangle = nullptr);

/// Why a drawn triangle has no place in the snapshot.
enum class Defect : std::uint8_t
{
  None,
  NonFinite, ///< a vertex is not finite, too large for a float, or missing
  ZeroArea   ///< its vertices lie on a line
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

/// Writes centred positions of a surface's vertices: worldFromModel * point - centreWorld in double
/// precision, rounded once to float. Points that are not finite stay so.
void placeVertices(vtkPolyData* data, const std::vector<std::uint32_t>& pointOfVertex,
  std::size_t vertexCount, const glm::dmat4& worldFromModel, const glm::dvec3& centreWorld,
  glm::vec3* positionsCentred);

/// A surface's texture coordinates, one for each of its vertices, as VTK's vertex shader makes them
/// of an array with one or two components: transform * (s, t, 0, 1) over its last component, in
/// float. What is not finite, or not in the array, becomes 0.
std::vector<glm::vec2> readTextureCoordinates(vtkDataArray* array, const glm::mat4& transform,
  const std::vector<std::uint32_t>& pointOfVertex, std::size_t vertexCount);

/// A surface's normals, one for each of its vertices, in model coordinates; none if the array has
/// too few.
std::vector<glm::vec3> readNormals(
  vtkDataArray* array, const std::vector<std::uint32_t>& pointOfVertex, std::size_t vertexCount);

/// What is wrong with a triangle at these positions.
Defect defectOf(const glm::uvec3& triangle, const glm::vec3* positionsCentred);

/// Sets the vertices that are not finite to zero. No kept triangle refers to them; this keeps NaN
/// out of buffers and boxes.
void clearNonFinite(glm::vec3* positionsCentred, std::size_t vertexCount);

} // namespace gnomon
