#include "shadowtech/base/SeenTriangle.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/SmoothFacet.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

/// The least height of a facet's curved surface, in pixels' sides, that counts.
/// Below it the steps of a terminator are no longer than a few pixels.
constexpr double leastHeightPixels = 0.25;

bool isFinite(const glm::dvec3& vector)
{
  return std::isfinite(vector.x + vector.y + vector.z);
}

/// Return the number of pieces in which clipping planes left a drawn triangle that is not dropped.
std::uint32_t piecesOf(const Surface& surface, std::uint32_t drawn)
{
  const auto here = surface.triangleOfDrawn.begin() + drawn;
  const auto next = std::find_if(here + 1, surface.triangleOfDrawn.end(),
    [](std::uint32_t triangle) { return triangle != Surface::noTriangle; });
  return (next == surface.triangleOfDrawn.end() ? surface.triangleCount : *next) - *here;
}

} // namespace

bool isFinite(const PixelRays& rays)
{
  return isFinite(rays.firstOrigin) && isFinite(rays.originPerColumn) &&
    isFinite(rays.originPerRow) && isFinite(rays.firstDirection) &&
    isFinite(rays.directionPerColumn) && isFinite(rays.directionPerRow);
}

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
  std::uint32_t drawn = number - block.firstPrimitive;
  if (drawn >= block.primitiveCount || block.surface >= occluders.surfaces.size())
  {
    return {};
  }
  const Surface& surface = occluders.surfaces[block.surface];
  std::uint32_t instance = 0;
  if (surface.isInstanced())
  {
    // Blocks without primitives returned above, so the divisor is not 0.
    instance = drawn / surface.drawnCount();
    drawn %= surface.drawnCount();
    if (instance >= surface.centredFromSource.size() ||
      Surface::isLeftOut(surface.centredFromSource[instance]))
    {
      return {};
    }
  }
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
  return { block.surface, surface.firstTriangle + triangle, instance, drawn,
    surface.triangleOfDrawn.empty() ? 1 : piecesOf(surface, drawn) };
}

void see(const Drawn& drawn, const TriangleOfFragment& found, SeenTriangle& seen)
{
  const Occluders& occluders = drawn.occluders;
  const PixelRays& rays = drawn.images.rays;
  const Surface& surface = occluders.surfaces[found.surface];
  const auto noise = [&](const SeenTriangle& of, const glm::vec3& normal, double doubleArea)
  {
    return noiseOf(
      occluders, surface, found.instance, found.triangle, of.corners, normal, doubleArea);
  };
  seen.surface = found.surface;
  seen.found = found;
  seen.known = Certainty::Uncertain;
  seen.solid.reset();
  seen.smoothNormals.reset();
  if (surface.solid != Solid::None)
  {
    seen.solid = placedSolid(surface.solid, surface.centredFromSource[found.instance]);
    seen.finite = drawn.raysFinite;
    return;
  }
  seen.corners = centredCorners(occluders, surface, found.instance, found.triangle);
  seen.finite = drawn.raysFinite && isFinite(seen.corners[0] + seen.corners[1] + seen.corners[2]);
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
    // No area, not finite, or seen along its plane: alongNormal stays 0, so no ray meets the
    // triangle. Shadow rays cannot meet it either, so its noise is that of an infinite area:
    // storage alone.
    seen.planeDistance = seen.alongNormal = {};
    seen.insideEdge = {};
    seen.normal = glm::vec3(0.0f);
    seen.noise = noise(seen, glm::vec3(1.0f), std::numeric_limits<double>::infinity());
    return;
  }
  // The area's vector points away from the camera if side > 0.
  if (drawn.findsCurves)
  {
    seen.smoothNormals = cornerNormals(
      occluders, found, glm::normalize(areaVector) * (side > 0.0 ? -1.0 : 1.0), side > 0.0);
    if (seen.smoothNormals &&
      (SmoothFacet(seen.corners, *seen.smoothNormals).largestHeight() <=
          leastHeightPixels * drawn.footprints.largest(seen.corners) ||
        surface.patches->isAtCrease(occluders, surface, found.triangle)))
    {
      seen.smoothNormals.reset();
    }
  }
  // Deciders know flat triangles only: the light may reach a curve above one that is turned away.
  if (drawn.decider && found.pieces == 1 && !surface.isInstanced() && !seen.smoothNormals)
  {
    seen.known = drawn.decider->ofTriangle(
      { found.triangle, side > 0.0, seen.corners, drawn.footprints.largest(seen.corners) });
    if (isDecided(seen.known))
    {
      return;
    }
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
  seen.noise = noise(seen, seen.normal, doubleArea);
}

glm::dvec3 closestToRay(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& origin,
  const glm::dvec3& direction, bool parallel)
{
  glm::dvec3 closest = corners[0];
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 from = corners[i] - origin;
    const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
    // The camera sees the edge in this plane. The ray is turned or moved into it, and meets the
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

glm::dvec3 inwards(
  const glm::dvec3& edge, const std::array<glm::dvec3, 3>& corners, double footprint)
{
  const glm::dvec3 toMiddle = (corners[0] + corners[1] + corners[2]) / 3.0 - edge;
  const double length = glm::length(toMiddle);
  const double step = footprint / 256.0;
  return length > 2.0 * step ? edge + step / length * toMiddle : edge + 0.5 * toMiddle;
}

double depthInside(const SeenTriangle& seen, double x, double y)
{
  double depth = std::numeric_limits<double>::infinity();
  for (const AffineOverPixels& edge : seen.insideEdge)
  {
    depth = std::min(depth, edge.row(y).at(x) / std::hypot(edge.perColumn, edge.perRow));
  }
  return depth;
}

const SeenTriangle& SeenTriangles::find(
  const Drawn& drawn, const glm::vec2& fragment, std::uint32_t piece)
{
  const float primitive = std::abs(fragment.y);
  const std::size_t slot =
    ((primitive < primitiveLimit ? static_cast<std::size_t>(primitive) : 0) + piece) % size;
  SeenTriangle& seen = this->seen_[slot];
  if (!this->filled_[slot] || this->fragments_[slot] != fragment || this->pieces_[slot] != piece)
  {
    this->filled_[slot] = true;
    this->fragments_[slot] = fragment;
    this->pieces_[slot] = piece;
    seen.finite = false;
    seen.found =
      findTriangle(std::abs(fragment.x), fragment.y, drawn.drawnSurfaces, drawn.occluders);
    if (seen.found.triangle != notFound)
    {
      TriangleOfFragment found = seen.found;
      found.triangle += piece;
      see(drawn, found, seen);
    }
  }
  return seen;
}

const SeenTriangle& SeenTriangles::findAt(
  const Drawn& drawn, const glm::vec2& fragment, double x, double y)
{
  const std::uint32_t pieces = this->find(drawn, fragment).found.pieces;
  std::uint32_t nearest = 0;
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::uint32_t piece = 0; pieces > 1 && piece < pieces; ++piece)
  {
    const double depth = depthInside(this->find(drawn, fragment, piece), x, y);
    if (depth > deepest)
    {
      deepest = depth;
      nearest = piece;
    }
  }
  return this->find(drawn, fragment, nearest);
}

} // namespace gnomon
