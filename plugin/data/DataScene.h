#pragma once

#include "lights/vtkGnomonVersions.h"
#include "shadowtech/base/Occluders.h"

#include "vtkType.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Polydata as shadow rays see them: the snapshot of their polygons and strips, as for a picture
/// (OccluderCollector), and each triangle's cell. The first polydata is the receivers.
class DataScene
{
public:
  struct Input
  {
    vtkPolyData* data;
    bool casts;
  };

  /// @param inputs the receivers, then the casters
  /// @throws std::runtime_error if there are more vertices than 32 bits count
  explicit DataScene(const std::vector<Input>& inputs);

  const Occluders& occluders() const { return this->occluders_; }

  /// Return the input of a surface of the snapshot.
  int inputOf(std::uint32_t surface) const { return this->parts_[surface].input; }
  /// Return the cell, in its polydata, of a triangle of the snapshot.
  vtkIdType cellOf(std::uint32_t surface, std::uint32_t triangle) const
  {
    return this->parts_[surface].firstCell + this->cellOfTriangle_[triangle];
  }

  /// Cells or points of the receivers with their triangles. Element `i` has triangles[first[i]] up
  /// to triangles[first[i + 1]].
  struct Elements
  {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> triangles;

    std::size_t count() const { return this->first.size() - 1; }
  };
  /// Return the triangles of each cell.
  Elements cells() const;
  /// Return the triangles that meet at each point. Triangles in one plane of one cell count once.
  Elements points() const;

  /// Return a triangle's corners, centred.
  std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const
  {
    const glm::uvec3& vertices = this->occluders_.triangles[triangle];
    const std::vector<glm::vec3>& positions = this->occluders_.positionsCentred;
    return { glm::dvec3(positions[vertices.x]), glm::dvec3(positions[vertices.y]),
      glm::dvec3(positions[vertices.z]) };
  }
  /// Return a point of the receivers, centred; nothing if no triangle of theirs uses it.
  std::optional<glm::dvec3> pointCentred(std::size_t point) const;

private:
  /// A surface of the snapshot.
  struct Part
  {
    int input;
    vtkIdType firstCell; ///< of its kind, in the polydata
  };
  void add(const Input& input, int number);
  /// Call visit(surface, triangle) for the receivers' triangles.
  template <typename Visit>
  void visitReceivers(const Visit& visit) const;
  std::uint32_t pointOf(std::uint32_t vertex) const;

  Occluders occluders_;
  std::vector<Part> parts_;                   ///< by surface
  std::vector<std::uint32_t> cellOfTriangle_; ///< counted from the part's first cell
  std::vector<std::uint32_t> pointOfVertex_;  ///< of the receivers' vertices
  std::vector<std::uint32_t> scratch_;        ///< triangulate()'s
  std::size_t cellCount_ = 0;                 ///< of the receivers
  std::size_t pointCount_ = 0;                ///< likewise
  std::vector<std::uint32_t> vertexOfPoint_;  ///< of the receivers; noVertex if there is none
};

} // namespace gnomon
