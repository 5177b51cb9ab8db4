#pragma once

#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PixelRays.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/Solid.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon
{

constexpr std::uint32_t notFound = 0xffffffffu;

struct TriangleOfFragment
{
  std::uint32_t surface = notFound;
  std::uint32_t triangle = notFound;
  std::uint32_t instance = 0;
  std::uint32_t primitive = 0; ///< VTK's number, counted from the surface's or instance's first
  std::uint32_t pieces = 1;    ///< in which clipping planes left it, from `triangle` on

  bool operator==(const TriangleOfFragment& other) const
  {
    return this->triangle == other.triangle && this->instance == other.instance &&
      this->surface == other.surface;
  }
};

/// A number that is affine over a row of pixels.
struct AffineOverRow
{
  double first;
  double perColumn;

  double at(double x) const { return this->first + x * this->perColumn; }
};

/// A number that is affine over the picture.
struct AffineOverPixels
{
  double first = 0.0; ///< at pixel (0, 0)
  double perColumn = 0.0;
  double perRow = 0.0;

  AffineOverRow row(double y) const { return { this->first + y * this->perRow, this->perColumn }; }
};

/// A triangle prepared for intersection with the pixels' rays.
///
/// Let O + t D be a ray, v0, v1, v2 the corners and N = (v1 - v0) x (v2 - v0). The ray meets the
/// plane at t = N.(v0 - O) / N.D. It passes edge (vi, vj) on the side of the sign of D.((vi - O) x
/// (vj - O)); the three of them sum to N.D. All of these are affine over the picture, because
/// either O or D is the same for all pixels.
struct SeenTriangle
{
  AffineOverPixels planeDistance;             ///< N.(v0 - O)
  AffineOverPixels alongNormal;               ///< N.D; both negated if the camera sees the back
  std::array<AffineOverPixels, 3> insideEdge; ///< not negative inside
  std::array<glm::dvec3, 3> corners;          ///< centred
  glm::vec3 normal{ 0.0f };                   ///< unit, on the camera's side; zero if there is none
  float noise = 0.0f;                         ///< planeNoise()
  std::uint32_t surface = notFound;
  bool finite = false;
  Certainty known =
    Certainty::Uncertain; ///< of all its receivers; if decided, the above is invalid
  /// The corners' normals, if they imply a curved surface (SmoothFacet).
  std::optional<std::array<glm::vec3, 3>> smoothNormals;
  TriangleOfFragment found;
  /// The solid that is seen instead of a triangle. If set, all above is invalid except the surface.
  std::optional<PlacedSolid> solid;
};

/// Floats hold primitive numbers below this one exactly.
constexpr float primitiveLimit = 16777216.0f;
/// Return the triangle that a fragment names; `notFound` if there is none.
TriangleOfFragment findTriangle(float drawnPlusOne, float primitive,
  const std::vector<DrawnSurface>& drawnSurfaces, const Occluders& occluders);

bool isFinite(const PixelRays& rays);

/// The size of pixels on triangles.
class Footprints
{
public:
  explicit Footprints(const PixelRays& rays)
    : origin_(rays.firstOrigin)
    , parallel_(glm::length(rays.originPerRow))
    , perDistance_(0.0)
  {
    if (!rays.parallel())
    {
      // A pixel's side is t times that of directionPerRow, at its receiver or in the plane across
      // it. At distance d, t is at most d over the shortest direction's length.
      const glm::dvec3 across =
        glm::normalize(glm::cross(rays.directionPerColumn, rays.directionPerRow));
      this->perDistance_ =
        glm::length(rays.directionPerRow) / std::abs(glm::dot(across, rays.firstDirection));
    }
  }

  /// Return the largest side of a pixel at a receiver on a triangle, in world units. It also bounds
  /// receivers whose pixel's ray misses the triangle.
  double largest(const std::array<glm::dvec3, 3>& corners) const
  {
    return this->parallel_ +
      this->perDistance_ *
      std::max({ glm::length(corners[0] - this->origin_), glm::length(corners[1] - this->origin_),
        glm::length(corners[2] - this->origin_) });
  }

private:
  glm::dvec3 origin_;
  double parallel_;
  double perDistance_; ///< from the origin
};
/// The input for computing receivers: the drawn images and surfaces, the snapshot, and the optional
/// decider.
struct Drawn
{
  const ReceiverImages& images;
  const std::vector<DrawnSurface>& drawnSurfaces;
  const Occluders& occluders;
  const ReceiverDecider* decider; ///< may be null
  bool findsCurves;               ///< false also if no surface has normals
  Footprints footprints;
  bool raysFinite;

  Drawn(const ReceiverImages& ofImages, const std::vector<DrawnSurface>& surfaces,
    const Occluders& snapshot, const ReceiverDecider* deciderOrNull, bool withCurves)
    : images(ofImages)
    , drawnSurfaces(surfaces)
    , occluders(snapshot)
    , decider(deciderOrNull)
    , findsCurves(withCurves && snapshot.hasPointNormals())
    , footprints(ofImages.rays)
    , raysFinite(isFinite(ofImages.rays))
  {
  }
};
/// Prepare a triangle for intersection with a picture's rays.
/// @param seen overwritten
void see(const Drawn& drawn, const TriangleOfFragment& found, SeenTriangle& seen);

/// Return how far a place lies inside the nearest of a triangle's edges, in pixels; negative:
/// outside.
/// @param x, y in pixels, from the centre of pixel (0, 0)
double depthInside(const SeenTriangle& seen, double x, double y);

/// A cache of prepared triangles by the fragments that name them. An entry's slot is the
/// primitive's number, plus the piece's, modulo the size.
class SeenTriangles
{
public:
  /// @param piece of a triangle that clipping planes cut
  /// @return valid until the next call; not finite if the snapshot has no such triangle
  const SeenTriangle& find(const Drawn& drawn, const glm::vec2& fragment, std::uint32_t piece = 0);

  /// Return the piece that is seen at a place in the picture.
  /// @param x, y in pixels, from the centre of pixel (0, 0)
  /// @return as find()
  const SeenTriangle& findAt(const Drawn& drawn, const glm::vec2& fragment, double x, double y);

private:
  static constexpr std::size_t size = 256;
  std::array<bool, size> filled_{};
  std::array<glm::vec2, size> fragments_;
  std::array<std::uint32_t, size> pieces_{};
  std::array<SeenTriangle, size> seen_;
};

/// Return the point of a triangle that is closest to a ray that misses it, as the camera sees it:
/// by angle with perspective, by distance in parallel projection. Triangles without area are
/// allowed.
glm::dvec3 closestToRay(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& origin,
  const glm::dvec3& direction, bool parallel);

/// Return a point on a triangle's edge, moved into the triangle by 1/256 of a pixel's side: the
/// rasteriser's error. On the edge itself it would lie on the neighbour's plane as well, and only
/// rounding would decide whether its shadow ray meets the neighbour.
glm::dvec3 inwards(
  const glm::dvec3& edge, const std::array<glm::dvec3, 3>& corners, double footprint);

} // namespace gnomon
