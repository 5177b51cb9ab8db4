#include "shadowtech/base/Receivers.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShadowRay.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon
{
namespace
{

constexpr std::uint32_t none = 0xffffffffu;

/// Where a fragment's triangle is in the snapshot.
struct TriangleOfFragment
{
  std::uint32_t surface = none;
  std::uint32_t triangle = none;
};

/// What the receivers of one triangle have in common.
struct Plane
{
  /// From view coordinates to the triangle's plane, in centred coordinates: x, y, z and
  /// translation.
  std::array<glm::dvec3, 4> planeFromView;
  glm::vec3 normal{ 0.0f }; ///< unit, on the camera's side; zero for a triangle without one
  float noise = 0.0f;       ///< planeNoise()
};

/// One pixel of ReceiverPixels; not covered unless said otherwise.
struct Receiver
{
  glm::vec3 position{ 0.0f };
  glm::vec3 normal{ 0.0f };
  float offset = 0.0f;
  std::uint32_t surface = ReceiverPixels::notCovered;
};

/// The largest primitive number that the images can hold exactly.
constexpr float primitiveLimit = 16777216.0f;

TriangleOfFragment findTriangle(float drawnPlusOne, float primitive,
  const std::vector<DrawnSurface>& drawnSurfaces, const Occluders& occluders)
{
  // Written so that NaN fails.
  if (!(drawnPlusOne >= 1.0f && drawnPlusOne <= static_cast<float>(drawnSurfaces.size()) &&
        primitive >= 0.0f && primitive < primitiveLimit))
  {
    return {};
  }
  const std::vector<DrawnSurface::Block>& blocks =
    drawnSurfaces[static_cast<std::size_t>(drawnPlusOne) - 1].blocks;
  const auto number = static_cast<std::uint32_t>(primitive);
  const auto after = std::upper_bound(blocks.begin(), blocks.end(), number,
    [](std::uint32_t value, const DrawnSurface::Block& block)
    { return value < block.firstPrimitive; });
  if (after == blocks.begin())
  {
    return {};
  }
  const DrawnSurface::Block& block = *(after - 1);
  const std::uint32_t drawn = number - block.firstPrimitive;
  if (drawn >= block.primitiveCount || block.surface >= occluders.surfaces.size())
  {
    return {};
  }
  const Surface& surface = occluders.surfaces[block.surface];
  std::uint32_t triangle = drawn;
  if (!surface.triangleOfDrawn.empty())
  {
    triangle =
      drawn < surface.triangleOfDrawn.size() ? surface.triangleOfDrawn[drawn] : Surface::noTriangle;
  }
  if (triangle >= surface.triangleCount)
  {
    return {};
  }
  return { block.surface, surface.firstTriangle + triangle };
}

/// The view's part in planeOf().
struct ViewFrame
{
  explicit ViewFrame(const ReceiverImages& images)
    : rotation(images.centredFromView)
    , position(images.centredFromView[3])
    , backward(images.centredFromView[2])
    , parallelProjection(images.parallelProjection)
  {
  }

  glm::dmat3 rotation;
  glm::dvec3 position; ///< the camera's, centred
  glm::dvec3 backward; ///< towards the camera
  bool parallelProjection;
};

Plane planeOf(const Occluders& occluders, std::uint32_t triangle, const ViewFrame& view)
{
  const glm::uvec3 corners = occluders.triangles[triangle];
  const glm::vec3 a = occluders.positionsCentred[corners.x];
  const glm::vec3 b = occluders.positionsCentred[corners.y];
  const glm::vec3 c = occluders.positionsCentred[corners.z];
  const glm::vec3 largest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const glm::vec3 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));

  Plane plane;
  const glm::dvec3 point(a);
  const glm::dvec3 areaVector = glm::cross(glm::dvec3(b) - point, glm::dvec3(c) - point);
  const double doubleArea = glm::length(areaVector);
  glm::dvec3 normal = areaVector / doubleArea;
  const double side =
    glm::dot(normal, view.parallelProjection ? view.backward : view.position - point);
  if (!(std::abs(side) > 0.0 && std::isfinite(side)))
  {
    // No area, not finite, or seen along its plane: the direction to the camera stands in for the
    // normal, and the position stays as it is.
    plane.planeFromView = { view.rotation[0], view.rotation[1], view.rotation[2], view.position };
    plane.noise = planeNoise(glm::vec3(1.0f), largest, glm::vec3(0.0f), 1.0f);
    return plane;
  }
  normal = side > 0.0 ? normal : -normal;
  const auto projected = [&](const glm::dvec3& vector)
  { return vector - glm::dot(vector, normal) * normal; };
  plane.planeFromView = { projected(view.rotation[0]), projected(view.rotation[1]),
    projected(view.rotation[2]), point + projected(view.position - point) };
  plane.normal = normal;
  plane.noise = planeNoise(plane.normal, largest, extent, static_cast<float>(doubleArea));
  return plane;
}

/// Planes of the triangles that a tile meets again and again; one entry per number modulo the size.
class PlaneCache
{
public:
  PlaneCache() { this->triangles_.fill(none); }

  template <typename Make>
  const Plane& find(std::uint32_t triangle, Make make)
  {
    const std::size_t slot = triangle % size;
    if (this->triangles_[slot] != triangle)
    {
      this->triangles_[slot] = triangle;
      this->planes_[slot] = make();
    }
    return this->planes_[slot];
  }

private:
  static constexpr std::size_t size = 512;
  std::array<std::uint32_t, size> triangles_;
  std::array<Plane, size> planes_;
};

} // namespace

//------------------------------------------------------------------------------
void projectReceivers(const ReceiverImages& images, const std::vector<DrawnSurface>& drawnSurfaces,
  const Occluders& occluders, ReceiverPixels& receivers)
{
  receivers.resize(images.width, images.height);
  const ViewFrame frame(images);
  const auto pixelSize = static_cast<float>(images.pixelSize);

  const auto receiverOf = [&](const glm::vec4& view, std::uint32_t surface, const Plane& plane)
  {
    const auto& columns = plane.planeFromView;
    Receiver receiver;
    receiver.position = columns[0] * static_cast<double>(view.x) +
      columns[1] * static_cast<double>(view.y) + columns[2] * static_cast<double>(view.z) +
      columns[3];
    receiver.normal = plane.normal;
    if (plane.normal == glm::vec3(0.0f))
    {
      receiver.normal = glm::normalize(
        frame.parallelProjection ? frame.backward : frame.rotation * -glm::dvec3(view));
    }
    const float footprint = frame.parallelProjection ? pixelSize : pixelSize * std::abs(view.z);
    receiver.offset = shadowRayOffset(plane.noise, footprint);
    receiver.surface = surface;
    const float sum = receiver.position.x + receiver.position.y + receiver.position.z +
      receiver.normal.x + receiver.normal.y + receiver.normal.z + receiver.offset;
    return std::isfinite(sum) ? receiver : Receiver(); // VTK draws broken numbers, too
  };
  const auto store = [&](std::size_t i, const Receiver& receiver)
  {
    receivers.positionX[i] = receiver.position.x;
    receivers.positionY[i] = receiver.position.y;
    receivers.positionZ[i] = receiver.position.z;
    receivers.normalX[i] = receiver.normal.x;
    receivers.normalY[i] = receiver.normal.y;
    receivers.normalZ[i] = receiver.normal.z;
    receivers.offset[i] = receiver.offset;
    receivers.surface[i] = receiver.surface;
  };
  /// Neighbours mostly share their triangle, and so what was looked up for it.
  const auto projectRow = [&](std::size_t first, std::size_t last, PlaneCache& cache)
  {
    float drawnPlusOne = 0.0f;
    float primitive = 0.0f;
    TriangleOfFragment found;
    const Plane* plane = nullptr;
    for (std::size_t i = first; i < last; ++i)
    {
      const glm::vec4& view = images.positionView[i];
      if (images.drawn[i] != drawnPlusOne || view.w != primitive)
      {
        drawnPlusOne = images.drawn[i];
        primitive = view.w;
        found = findTriangle(std::abs(drawnPlusOne), primitive, drawnSurfaces, occluders);
        if (found.triangle != none)
        {
          plane =
            &cache.find(found.triangle, [&] { return planeOf(occluders, found.triangle, frame); });
        }
      }
      store(i, found.triangle == none ? Receiver() : receiverOf(view, found.surface, *plane));
    }
  };

  constexpr std::size_t tileRows = 8;
  constexpr std::size_t tileColumns = 256;
  const auto width = static_cast<std::size_t>(images.width);
  const auto height = static_cast<std::size_t>(images.height);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (height + tileRows - 1) / tileRows),
    [&](const tbb::blocked_range<std::size_t>& bands)
    {
      PlaneCache cache;
      for (std::size_t band = bands.begin(); band != bands.end(); ++band)
      {
        const std::size_t lastRow = std::min((band + 1) * tileRows, height);
        for (std::size_t column = 0; column < width; column += tileColumns)
        {
          const std::size_t lastColumn = std::min(column + tileColumns, width);
          for (std::size_t y = band * tileRows; y < lastRow; ++y)
          {
            projectRow(y * width + column, y * width + lastColumn, cache);
          }
        }
      }
    });
}

} // namespace gnomon
