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

/// Polydata as shadow rays see them: the snapshot of their polygons and strips, as a picture has it
/// (OccluderCollector), and the cell that each triangle is of. The first one is the receivers.
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

  /// The input that a surface of the snapshot is of.
  int inputOf(std::uint32_t surface) const { return this->parts_[surface].input; }
  /// The cell, in its polydata, that a triangle of the snapshot is of.
  vtkIdType cellOf(std::uint32_t surface, std::uint32_t triangle) const
  {
    return this->parts_[surface].firstCell + this->cellOfTriangle_[triangle];
  }

  /// Cells or points of the receivers, and the triangles at each: those of element `i` are
  /// triangles[first[i]] up to triangles[first[i + 1]].
  struct Elements
  {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> triangles;

    std::size_t count() const { return this->first.size() - 1; }
  };
  /// The triangles of each cell.
  Elements cells() const;
  /// Of each point, the triangles that meet there, but one alone of those that lie in one plane of
  /// one cell.
  Elements points() const;

  /// A triangle's corners, centred.
  std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const
  {
    const glm::uvec3& vertices = this->occluders_.triangles[triangle];
    const std::vector<glm::vec3>& positions = this->occluders_.positionsCentred;
    return { glm::dvec3(positions[vertices.x]), glm::dvec3(positions[vertices.y]),
      glm::dvec3(positions[vertices.z]) };
  }
  /// A point of the receivers, centred; nothing if no triangle of theirs uses it.
  std::optional<glm::dvec3> pointCentred(std::size_t point) const;

private:
  /// A surface of the snapshot.
  struct Part
  {
    int input;
    vtkIdType firstCell; ///< of its kind, in the polydata
  };
  void add(const Input& input, int number);
  /// Calls visit(surface, triangle) for the receivers' triangles.
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
  std::vector<std::uint32_t> vertexOfPoint_;  ///< of the receivers; noVertex where there is none
};

} // namespace gnomon
