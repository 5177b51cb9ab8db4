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
  glm::dvec3 point{ 0.0 };
  glm::dvec3 normal{ 0.0 }; ///< unit, on the camera's side; zero for a triangle without one
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

/// @param camera the camera's centred position, or (parallel projection) a vector towards it
Plane planeOf(const Occluders& occluders, std::uint32_t triangle, const glm::dvec3& camera,
  bool parallelProjection)
{
  const glm::uvec3 corners = occluders.triangles[triangle];
  const glm::vec3 a = occluders.positionsCentred[corners.x];
  const glm::vec3 b = occluders.positionsCentred[corners.y];
  const glm::vec3 c = occluders.positionsCentred[corners.z];

  Plane plane;
  plane.point = a;
  const glm::dvec3 areaVector =
    glm::cross(glm::dvec3(b) - plane.point, glm::dvec3(c) - plane.point);
  const double doubleArea = glm::length(areaVector);
  glm::dvec3 normal = areaVector / doubleArea;
  const double side = glm::dot(normal, parallelProjection ? camera : camera - plane.point);
  // No area, not finite, or seen along its plane: the image knows better.
  if (!(std::abs(side) > 0.0 && std::isfinite(side)))
  {
    return plane;
  }
  plane.normal = side > 0.0 ? normal : -normal;
  const glm::vec3 largest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const glm::vec3 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
  plane.noise =
    planeNoise(glm::vec3(plane.normal), largest, extent, static_cast<float>(doubleArea));
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
  static constexpr std::size_t size = 256;
  std::array<std::uint32_t, size> triangles_;
  std::array<Plane, size> planes_;
};

} // namespace

//------------------------------------------------------------------------------
void projectReceivers(const ReceiverImages& images, const std::vector<DrawnSurface>& drawnSurfaces,
  const Occluders& occluders, ReceiverPixels& receivers)
{
  receivers.resize(images.width, images.height);
  const glm::dmat4& centredFromView = images.centredFromView;
  const glm::dmat3 rotation(centredFromView);
  const glm::dvec3 camera =
    images.parallelProjection ? glm::dvec3(centredFromView[2]) : glm::dvec3(centredFromView[3]);

  const auto receiverOf = [&](const glm::vec4& view, const glm::vec4& normalView, PlaneCache& cache)
  {
    const TriangleOfFragment found =
      findTriangle(std::abs(normalView.w), view.w, drawnSurfaces, occluders);
    if (found.triangle == none)
    {
      return Receiver();
    }
    const Plane& plane = cache.find(found.triangle,
      [&] { return planeOf(occluders, found.triangle, camera, images.parallelProjection); });

    glm::dvec3 position(centredFromView * glm::dvec4(glm::dvec3(view), 1.0));
    Receiver receiver;
    float noise = plane.noise;
    if (plane.normal == glm::dvec3(0.0))
    {
      receiver.normal = glm::normalize(rotation * glm::dvec3(normalView));
      noise = planeNoise(receiver.normal, glm::abs(glm::vec3(position)), glm::vec3(0.0f), 1.0f);
    }
    else
    {
      position -= glm::dot(position - plane.point, plane.normal) * plane.normal;
      receiver.normal = plane.normal;
    }
    const double footprint =
      images.pixelSize * (images.parallelProjection ? 1.0 : std::abs(static_cast<double>(view.z)));
    receiver.position = position;
    receiver.offset = shadowRayOffset(noise, static_cast<float>(footprint));
    receiver.surface = found.surface;
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

  constexpr std::size_t tileRows = 16;
  constexpr std::size_t tileColumns = 64;
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
            for (std::size_t x = column; x < lastColumn; ++x)
            {
              const std::size_t i = y * width + x;
              store(i, receiverOf(images.positionView[i], images.normalView[i], cache));
            }
          }
        }
      }
    });
}

} // namespace gnomon
