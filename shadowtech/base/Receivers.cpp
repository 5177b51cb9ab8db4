#include "shadowtech/base/Receivers.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShadowRay.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/// A number that is affine over the picture.
struct AffineOverPixels
{
  double first = 0.0; ///< at pixel (0, 0)
  double perColumn = 0.0;
  double perRow = 0.0;

  double at(double x, double y) const
  {
    return this->first + x * this->perColumn + y * this->perRow;
  }
};

/// A triangle as the pixels' rays meet it.
///
/// Let O + t D be a ray, v0, v1, v2 the corners and N = (v1 - v0) x (v2 - v0). The ray meets the
/// plane at t = N.(v0 - O) / N.D, and passes edge (vi, vj) on the side of the sign of
/// D.((vi - O) x (vj - O)); the three of them add up to N.D. All of these are affine over the
/// picture, as either O or D is the same for all pixels.
struct SeenTriangle
{
  AffineOverPixels planeDistance; ///< N.(v0 - O)
  AffineOverPixels alongNormal;   ///< N.D; both negated where the camera sees the triangle's back
  std::array<AffineOverPixels, 3> insideEdge; ///< not negative inside
  std::array<glm::dvec3, 3> corners;          ///< centred
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

SeenTriangle see(const Occluders& occluders, std::uint32_t triangle, const PixelRays& rays)
{
  const glm::uvec3 corners = occluders.triangles[triangle];
  const glm::vec3 a = occluders.positionsCentred[corners.x];
  const glm::vec3 b = occluders.positionsCentred[corners.y];
  const glm::vec3 c = occluders.positionsCentred[corners.z];
  const glm::vec3 largest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const glm::vec3 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));

  SeenTriangle seen;
  seen.corners = { a, b, c };
  glm::dvec3 areaVector =
    glm::cross(seen.corners[1] - seen.corners[0], seen.corners[2] - seen.corners[0]);
  const auto planeDistance = [&](const glm::dvec3& areaVectorSeen)
  {
    return AffineOverPixels{ glm::dot(areaVectorSeen, seen.corners[0] - rays.firstOrigin),
      -glm::dot(areaVectorSeen, rays.originPerColumn),
      -glm::dot(areaVectorSeen, rays.originPerRow) };
  };
  const auto alongNormal = [&](const glm::dvec3& areaVectorSeen)
  {
    return AffineOverPixels{ glm::dot(areaVectorSeen, rays.firstDirection),
      glm::dot(areaVectorSeen, rays.directionPerColumn),
      glm::dot(areaVectorSeen, rays.directionPerRow) };
  };
  // From the eye, the plane's distance has one sign everywhere; parallel rays pass it in one
  // direction.
  const double side =
    rays.parallel() ? alongNormal(areaVector).first : planeDistance(areaVector).first;
  if (!(std::abs(side) > 0.0 && std::isfinite(side)))
  {
    // No area, not finite, or seen along its plane: alongNormal stays 0, so that no ray meets it.
    seen.noise = planeNoise(glm::vec3(1.0f), largest, glm::vec3(0.0f), 1.0f);
    return seen;
  }
  const double orientation = side > 0.0 ? 1.0 : -1.0;
  areaVector *= orientation;
  seen.planeDistance = planeDistance(areaVector);
  seen.alongNormal = alongNormal(areaVector);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 from = seen.corners[i] - rays.firstOrigin;
    const glm::dvec3 edge = seen.corners[(i + 1) % 3] - seen.corners[i];
    const glm::dvec3 across = orientation * glm::cross(from, edge);
    const glm::dvec3 lever = orientation * glm::cross(edge, rays.firstDirection);
    seen.insideEdge[i] = { glm::dot(across, rays.firstDirection),
      glm::dot(across, rays.directionPerColumn) - glm::dot(lever, rays.originPerColumn),
      glm::dot(across, rays.directionPerRow) - glm::dot(lever, rays.originPerRow) };
  }
  const double doubleArea = glm::length(areaVector);
  seen.normal = -areaVector / doubleArea;
  seen.noise = planeNoise(seen.normal, largest, extent, static_cast<float>(doubleArea));
  return seen;
}

/// The point of a triangle that a ray which passes it by comes closest to, as the camera sees it: by
/// angle with perspective, by distance in parallel projection. Serves triangles without area, too.
glm::dvec3 closestToRay(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& origin,
  const glm::dvec3& direction, bool parallel)
{
  glm::dvec3 closest = corners[0];
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 from = corners[i] - origin;
    const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
    // The plane in which the camera sees the edge. The ray is turned or moved into it, and meets the
    // edge at from + u edge. An edge seen end-on has no such plane; any of its points will do.
    const glm::dvec3 across = parallel ? glm::cross(direction, edge) : glm::cross(from, edge);
    const double acrossSquared = glm::dot(across, across);
    double u = 0.0;
    if (acrossSquared > 0.0)
    {
      const glm::dvec3 within = direction - glm::dot(direction, across) / acrossSquared * across;
      const double denominator = glm::dot(glm::cross(within, edge), across);
      u = denominator != 0.0 ? glm::dot(glm::cross(from, within), across) / denominator : 0.0;
      u = glm::clamp(u, 0.0, 1.0);
    }
    const glm::dvec3 candidate = from + u * edge;
    const glm::dvec3 off = glm::cross(candidate, direction);
    double gap = glm::dot(off, off);
    if (!parallel)
    {
      gap /= glm::dot(candidate, candidate);
      if (!(glm::dot(candidate, direction) > 0.0))
      {
        gap = 2.0 * glm::dot(direction, direction); // behind the camera: beyond a right angle
      }
    }
    if (gap < smallest)
    {
      smallest = gap;
      closest = origin + candidate;
    }
  }
  return closest;
}

/// Triangles that a tile meets again and again; one entry per number modulo the size.
class SeenTriangles
{
public:
  SeenTriangles() { this->triangles_.fill(none); }

  template <typename Make>
  const SeenTriangle& find(std::uint32_t triangle, Make make)
  {
    const std::size_t slot = triangle % size;
    if (this->triangles_[slot] != triangle)
    {
      this->triangles_[slot] = triangle;
      this->seen_[slot] = make();
    }
    return this->seen_[slot];
  }

private:
  static constexpr std::size_t size = 256;
  std::array<std::uint32_t, size> triangles_;
  std::array<SeenTriangle, size> seen_;
};

Receiver meet(const SeenTriangle& seen, const PixelRays& rays, double x, double y)
{
  const glm::dvec3 origin = rays.origin(x, y);
  const glm::dvec3 direction = rays.direction(x, y);
  const double alongNormal = seen.alongNormal.at(x, y);
  double t = seen.planeDistance.at(x, y) / alongNormal;
  Receiver receiver;
  // Written so that NaN fails.
  const bool inside = seen.insideEdge[0].at(x, y) >= 0.0 && seen.insideEdge[1].at(x, y) >= 0.0 &&
    seen.insideEdge[2].at(x, y) >= 0.0 && alongNormal > 0.0;
  if (inside)
  {
    receiver.position = origin + t * direction;
  }
  else
  {
    const glm::dvec3 position = closestToRay(seen.corners, origin, direction, rays.parallel());
    receiver.position = position;
    t = glm::dot(position - origin, direction) / glm::dot(direction, direction);
  }
  receiver.normal = seen.normal;
  if (seen.normal == glm::vec3(0.0f))
  {
    receiver.normal = -glm::normalize(direction);
  }
  receiver.offset = shadowRayOffset(
    seen.noise, static_cast<float>(glm::length(rays.originPerRow + t * rays.directionPerRow)));
  return receiver;
}

} // namespace

//------------------------------------------------------------------------------
void projectReceivers(const ReceiverImages& images, const std::vector<DrawnSurface>& drawnSurfaces,
  const Occluders& occluders, ReceiverPixels& receivers)
{
  receivers.resize(images.width, images.height);

  const auto receiverOf =
    [&](const TriangleOfFragment& found, const SeenTriangle& seen, std::size_t x, std::size_t y)
  {
    Receiver receiver = meet(seen, images.rays, static_cast<double>(x), static_cast<double>(y));
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
  const auto width = static_cast<std::size_t>(images.width);
  const auto height = static_cast<std::size_t>(images.height);
  /// Neighbours mostly share their triangle, and so what was looked up for it.
  const auto projectRow =
    [&](std::size_t y, std::size_t firstColumn, std::size_t lastColumn, SeenTriangles& cache)
  {
    glm::vec2 fragment(0.0f);
    TriangleOfFragment found;
    const SeenTriangle* seen = nullptr;
    for (std::size_t x = firstColumn; x < lastColumn; ++x)
    {
      const std::size_t i = y * width + x;
      if (images.fragments[i] != fragment)
      {
        fragment = images.fragments[i];
        found = findTriangle(std::abs(fragment.x), fragment.y, drawnSurfaces, occluders);
        if (found.triangle != none)
        {
          seen = &cache.find(
            found.triangle, [&] { return see(occluders, found.triangle, images.rays); });
        }
      }
      store(i, found.triangle == none ? Receiver() : receiverOf(found, *seen, x, y));
    }
  };

  constexpr std::size_t tileRows = 8;
  constexpr std::size_t tileColumns = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (height + tileRows - 1) / tileRows),
    [&](const tbb::blocked_range<std::size_t>& bands)
    {
      SeenTriangles cache;
      for (std::size_t band = bands.begin(); band != bands.end(); ++band)
      {
        const std::size_t lastRow = std::min((band + 1) * tileRows, height);
        for (std::size_t column = 0; column < width; column += tileColumns)
        {
          const std::size_t lastColumn = std::min(column + tileColumns, width);
          for (std::size_t y = band * tileRows; y < lastRow; ++y)
          {
            projectRow(y, column, lastColumn, cache);
          }
        }
      }
    });
}

} // namespace gnomon
