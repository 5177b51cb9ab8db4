#pragma once

#include "lights/LightView.h"
#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

namespace gnomon
{

/// A triangle that casts, where it stands.
struct CasterTriangle
{
  std::uint32_t surface = none;  ///< of the snapshot; `none` for no triangle
  std::uint32_t instance = 0;    ///< of a surface with instances
  std::uint32_t triangle = none; ///< of the snapshot

  static constexpr std::uint32_t none = 0xffffffffu;

  bool exists() const { return this->surface != none; }
  bool operator==(const CasterTriangle& other) const
  {
    return this->surface == other.surface && this->instance == other.instance &&
      this->triangle == other.triangle;
  }
  bool operator<(const CasterTriangle& other) const
  {
    return std::tie(this->surface, this->instance, this->triangle) <
      std::tie(other.surface, other.instance, other.triangle);
  }
};

/// What a map has at a texel's centre: the caster that is nearest to the light there.
struct TriangleTexel
{
  CasterTriangle caster;
  float depth = std::numeric_limits<float>::infinity(); ///< at the centre
  ///@{
  /// What depth changes by on the caster's plane, to the next texel.
  float perColumn = 0.0f;
  float perRow = 0.0f;
  ///@}
};

/// A shadow ray as a map sees it: as one point, where it starts.
struct MapPlace
{
  int column = 0, row = 0; ///< the texel that holds the point
  double x = 0.0, y = 0.0; ///< in texels
  double depth = 0.0;
  /// The plane of the receiver, moved to where the ray starts: over (x, y, depth, 1), positive on
  /// the side that the camera sees.
  glm::dvec4 plane{ 0.0 };
};

/// The texels around a place, in squares.
enum class Neighbourhood
{
  Centre, ///< the texel that holds it
  Four,   ///< with the three nearest to it: those that a bilinear filter weighs
  Nine    ///< with all that touch it
};

/// A shadow map of one view of a light that also says which triangle it saw: at the centre of each
/// texel, as Williams' (1978). Drawn on the CPU, in double precision; both sides of casters count,
/// but of those that are one-sided, and the holes of textures are left out.
///
/// *Depth* is that of conservative maps (ConservativeMap.h), affine on planes across the map and
/// growing along every ray, but that it ends at 0, behind all casters, so that floats hold it well.
class TriangleMap
{
public:
  /// Draws the casters.
  /// @param keptFromCentred of a light with a box: a plane (n, d) in centred coordinates, no deeper
  /// than the view's box; of casters, only what has n.p + d >= 0 counts
  TriangleMap(const LightView& view, const std::optional<glm::dvec4>& keptFromCentred,
    int sizeTexels, const Occluders& occluders);

  /// Where a shadow ray lies on the map; nothing where it lies beside it.
  /// @param origin where it starts, centred
  /// @param normal of its receiver, on the camera's side
  std::optional<MapPlace> placeOf(const glm::dvec3& origin, const glm::dvec3& normal) const;

  /// A texel; an empty one outside of the map.
  const TriangleTexel& texel(int column, int row) const;

  /// Whether the caster at a texel's centre hides a receiver, as far as that can be told: its plane
  /// passes between the receiver and the light, and at the centre, even pushed back by what it may
  /// be deeper on the way to the receiver's place, it lies before the receiver's plane.
  ///
  /// No bias is tuned. A triangle does neither to its own points. Where a surface is convex,
  /// neighbours lie behind the receiver's plane; where it is concave, the receiver lies before
  /// theirs. What is left are surfaces that are both within a texel.
  bool shadows(const TriangleTexel& texel, int column, int row, const MapPlace& place) const;
  bool shadows(int column, int row, const MapPlace& place) const
  {
    return this->shadows(this->texel(column, row), column, row, place);
  }

  std::size_t bytes() const;

private:
  int size_;
  glm::dmat4 mapFromCentred_;   ///< to X, Y, Q and W of MapPoint
  glm::dmat4 planeFromCentred_; ///< its inverse, transposed: takes planes
  std::vector<TriangleTexel> texels_;
};

/// Visits the texels of a neighbourhood, the one that holds the place first.
/// @param visit called with column and row, inside of the map or not; returns whether that is
/// enough
/// @return whether it was
template <typename Visit>
bool visitNeighbourhood(Neighbourhood neighbourhood, const MapPlace& place, const Visit& visit)
{
  if (visit(place.column, place.row))
  {
    return true;
  }
  const int nearerColumn = place.x - place.column < 0.5 ? -1 : 1;
  const int nearerRow = place.y - place.row < 0.5 ? -1 : 1;
  for (int y = -1; y <= 1 && neighbourhood != Neighbourhood::Centre; ++y)
  {
    for (int x = -1; x <= 1; ++x)
    {
      const bool isNear = (x == 0 || x == nearerColumn) && (y == 0 || y == nearerRow);
      const bool isCentre = x == 0 && y == 0;
      if (!isCentre && (isNear || neighbourhood == Neighbourhood::Nine) &&
        visit(place.column + x, place.row + y))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace gnomon
