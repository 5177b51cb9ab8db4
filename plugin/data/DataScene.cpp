#include "plugin/data/DataScene.h"

#include "plugin/scene/SurfaceExtraction.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace gnomon
{
namespace
{

constexpr std::uint32_t noVertex = std::numeric_limits<std::uint32_t>::max();

/// Snapshots of several filters may exist in one process, but a tracer sees one only.
constexpr std::uint64_t onlyVersion = 1;

/// Normals whose cosine exceeds this lie on one plane.
constexpr double onePlane = 1.0 - 1e-6;

/// Return the unit normal on the front, which shows the corners counter-clockwise.
glm::dvec3 normalOf(const std::array<glm::dvec3, 3>& corners)
{
  return glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

/// Turn the counts in first[1] and on into offsets, which a second pass fills.
void sumUp(std::vector<std::uint32_t>& first)
{
  std::partial_sum(first.begin(), first.end(), first.begin());
}

} // namespace

DataScene::DataScene(const std::vector<Input>& inputs)
{
  Bounds boundsWorld;
  for (const Input& input : inputs)
  {
    if (input.data->GetPoints() && input.data->GetNumberOfPoints() > 0)
    {
      for (vtkIdType i = 0; i < input.data->GetNumberOfPoints(); ++i)
      {
        glm::dvec3 point;
        input.data->GetPoint(i, &point.x);
        if (isWithin(point, largestOfWorld))
        {
          boundsWorld.add(point);
        }
      }
    }
  }
  this->occluders_.frame = sceneFrameOf(boundsWorld);
  this->occluders_.topologyVersion = this->occluders_.positionsVersion = onlyVersion;
  this->cellCount_ = static_cast<std::size_t>(inputs.front().data->GetNumberOfCells());
  this->pointCount_ = static_cast<std::size_t>(inputs.front().data->GetNumberOfPoints());
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    this->add(inputs[i], static_cast<int>(i));
  }
  this->scratch_ = {};
  // Embree reads every position as 16 bytes.
  this->occluders_.positionsCentred.reserve(this->occluders_.positionsCentred.size() + 1);
  this->vertexOfPoint_.assign(this->pointCount_, noVertex);
  for (std::size_t vertex = 0; vertex < this->pointOfVertex_.size(); ++vertex)
  {
    this->vertexOfPoint_[this->pointOfVertex_[vertex]] = static_cast<std::uint32_t>(vertex);
  }
}

void DataScene::add(const Input& input, int number)
{
  vtkIdType firstCell = input.data->GetNumberOfVerts() + input.data->GetNumberOfLines();
  for (const SurfaceCells kind : { SurfaceCells::Polygons, SurfaceCells::Strips })
  {
    const vtkIdType cells = cellCount(input.data, kind);
    if (cells > 0)
    {
      std::vector<std::uint32_t> cellOf;
      const DrawnTriangles drawn = triangulate(input.data, kind, this->scratch_, &cellOf);
      Surface surface;
      surface.firstVertex = static_cast<std::uint32_t>(this->occluders_.positionsCentred.size());
      surface.vertexCount = drawn.vertexCount;
      surface.firstTriangle = static_cast<std::uint32_t>(this->occluders_.triangles.size());
      surface.casts = input.casts;
      surface.topologyVersion = surface.positionsVersion = this->occluders_.surfaces.size() + 1;
      const std::size_t vertices =
        this->occluders_.positionsCentred.size() + static_cast<std::size_t>(drawn.vertexCount);
      if (vertices >= noVertex || this->occluders_.triangles.size() + cellOf.size() >= noVertex)
      {
        throw std::runtime_error("more than 4,294,967,295 vertices or triangles");
      }
      this->occluders_.positionsCentred.resize(vertices);
      glm::vec3* const positions = &this->occluders_.positionsCentred[surface.firstVertex];
      placeVertices(input.data, drawn.pointOfVertex, drawn.vertexCount, glm::dmat4(1.0),
        this->occluders_.frame, positions);
      for (std::size_t i = 0; i < drawn.triangles.size(); ++i)
      {
        if (defectOf(drawn.triangles[i], positions) == Defect::None)
        {
          this->occluders_.triangles.push_back(drawn.triangles[i] + surface.firstVertex);
          this->cellOfTriangle_.push_back(cellOf[i]);
          for (int corner = 0; input.casts && corner < 3; ++corner)
          {
            this->occluders_.castersCentred.add(positions[drawn.triangles[i][corner]]);
          }
        }
      }
      clearNonFinite(positions, drawn.vertexCount);
      surface.triangleCount =
        static_cast<std::uint32_t>(this->occluders_.triangles.size()) - surface.firstTriangle;
      this->occluders_.surfaces.push_back(surface);
      this->parts_.push_back({ number, firstCell });
      for (std::uint32_t vertex = 0; number == 0 && vertex < drawn.vertexCount; ++vertex)
      {
        this->pointOfVertex_.push_back(
          drawn.pointOfVertex.empty() ? vertex : drawn.pointOfVertex[vertex]);
      }
    }
    firstCell += input.data->GetNumberOfPolys();
  }
}

template <typename Visit>
void DataScene::visitReceivers(const Visit& visit) const
{
  for (std::uint32_t i = 0; i < this->parts_.size(); ++i)
  {
    const Surface& surface = this->occluders_.surfaces[i];
    for (std::uint32_t j = 0; this->parts_[i].input == 0 && j < surface.triangleCount; ++j)
    {
      visit(i, surface.firstTriangle + j);
    }
  }
}

DataScene::Elements DataScene::cells() const
{
  Elements elements;
  elements.first.assign(this->cellCount_ + 1, 0);
  this->visitReceivers([&](std::uint32_t surface, std::uint32_t triangle)
    { ++elements.first[static_cast<std::size_t>(this->cellOf(surface, triangle)) + 1]; });
  sumUp(elements.first);
  elements.triangles.resize(elements.first.back());
  std::vector<std::uint32_t> next(elements.first.begin(), elements.first.end() - 1);
  this->visitReceivers(
    [&](std::uint32_t surface, std::uint32_t triangle)
    {
      elements.triangles[next[static_cast<std::size_t>(this->cellOf(surface, triangle))]++] =
        triangle;
    });
  return elements;
}

DataScene::Elements DataScene::points() const
{
  Elements all;
  all.first.assign(this->pointCount_ + 1, 0);
  const auto visitCorners = [this](const auto& visit)
  {
    this->visitReceivers(
      [&](std::uint32_t, std::uint32_t triangle)
      {
        for (int corner = 0; corner < 3; ++corner)
        {
          visit(this->pointOfVertex_[this->occluders_.triangles[triangle][corner]], triangle);
        }
      });
  };
  visitCorners([&](std::uint32_t point, std::uint32_t) { ++all.first[point + 1]; });
  sumUp(all.first);
  all.triangles.resize(all.first.back());
  std::vector<std::uint32_t> next(all.first.begin(), all.first.end() - 1);
  visitCorners(
    [&](std::uint32_t point, std::uint32_t triangle) { all.triangles[next[point]++] = triangle; });

  Elements elements;
  elements.first.assign(1, 0);
  elements.first.reserve(all.first.size());
  for (std::size_t point = 0; point < this->pointCount_; ++point)
  {
    const std::size_t begin = elements.triangles.size();
    for (std::uint32_t i = all.first[point]; i < all.first[point + 1]; ++i)
    {
      const std::uint32_t triangle = all.triangles[i];
      const glm::dvec3 normal = normalOf(this->corners(triangle));
      const bool isKnown = std::any_of(
        elements.triangles.begin() + static_cast<std::ptrdiff_t>(begin), elements.triangles.end(),
        [&](std::uint32_t other)
        {
          return this->cellOfTriangle_[other] == this->cellOfTriangle_[triangle] &&
            glm::dot(normalOf(this->corners(other)), normal) > onePlane;
        });
      if (!isKnown)
      {
        elements.triangles.push_back(triangle);
      }
    }
    elements.first.push_back(static_cast<std::uint32_t>(elements.triangles.size()));
  }
  return elements;
}

std::optional<glm::dvec3> DataScene::pointCentred(std::size_t point) const
{
  const std::uint32_t vertex = this->vertexOfPoint_[point];
  return vertex == noVertex ? std::nullopt
                            : std::optional(glm::dvec3(this->occluders_.positionsCentred[vertex]));
}

} // namespace gnomon
