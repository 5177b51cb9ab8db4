#pragma once

#include "lights/LightView.h"
#include "lights/LightViews.h"
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

/// A casting triangle of one instance.
struct CasterTriangle
{
  std::uint32_t surface = none;  ///< in the snapshot; `none` for no triangle
  std::uint32_t instance = 0;    ///< of a surface with instances
  std::uint32_t triangle = none; ///< number in the snapshot

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

/// The caster nearest to the light at a texel's centre.
struct TriangleTexel
{
  CasterTriangle caster;
  float depth = std::numeric_limits<float>::infinity(); ///< at the centre
  ///@{
  /// Change of depth on the caster's plane to the next texel.
  float perColumn = 0.0f;
  float perRow = 0.0f;
  ///@}
};

/// Where a shadow ray starts, on a map.
struct MapPlace
{
  int column = 0, row = 0; ///< the texel that holds the point
  double x = 0.0, y = 0.0; ///< in texels
  double depth = 0.0;
  /// The receiver's plane, moved to the ray's start. Its product with (x, y, depth, 1) is positive
  /// on the side that the camera sees.
  glm::dvec4 plane{ 0.0 };
};

/// Squares of texels around a place.
enum class Neighbourhood
{
  Centre, ///< the texel that holds the place
  Four,   ///< with the three nearest to the place, as a bilinear filter weighs
  Nine    ///< with all that touch its texel
};

/// A shadow map of one view of a light that also stores which triangle is nearest at the centre of
/// each texel, as Williams' (1978). It is baked on the CPU, in double precision. Both sides of
/// casters count, unless they are one-sided. Holes of textures are left out.
///
/// *Depth* is that of conservative maps (ConservativeMap.h), affine on planes across the map and
/// growing along every ray. It ends at 0, behind all casters, to suit the precision of floats.
class TriangleMap
{
public:
  /// Bake the casters.
  /// @param keptFromCentred for lights with a box, a plane (n, d) in centred coordinates, no deeper
  /// than the view's box; only parts of casters with n.p + d >= 0 count
  TriangleMap(const LightView& view, const std::optional<glm::dvec4>& keptFromCentred,
    int sizeTexels, const Occluders& occluders);

  /// Return where a shadow ray starts on the map; nothing if that is outside.
  /// @param origin where it starts, centred
  /// @param normal of its receiver, on the camera's side
  std::optional<MapPlace> placeOf(const glm::dvec3& origin, const glm::dvec3& normal) const;

  /// Return a texel; an empty one outside the map.
  const TriangleTexel& texel(int column, int row) const;

  /// Return true if the caster at a texel's centre hides a receiver, as far as the map can tell.
  /// Two conditions must hold:
  /// - the caster's plane passes between the receiver and the light;
  /// - at the centre, the caster lies before the receiver's plane, even if pushed back. The push is
  ///   its largest change of depth on the way to the receiver's place.
  ///
  /// No bias is tuned. A triangle meets neither condition for its own points. Where a surface is
  /// convex, neighbours lie behind the receiver's plane. Where it is concave, the receiver lies
  /// before theirs. Only surfaces that are both within a texel remain.
  bool shadows(int column, int row, const MapPlace& place) const;

  std::size_t bytes() const;

private:
  int size_;
  glm::dmat4 mapFromCentred_;   ///< to X, Y, Q and W of MapPoint
  glm::dmat4 planeFromCentred_; ///< its inverse transposed, which maps planes
  std::vector<TriangleTexel> texels_;
};

/// Visit the texels of a neighbourhood, the one that holds the place first.
/// @param visit called with column and row, inside the map or not; returns true to stop
/// @return true if `visit` stopped
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

/// A shadow ray's start on one of the maps of a light.
struct PlaceOnMaps
{
  const TriangleMap* map; ///< valid as long as the maps exist
  MapPlace place;

  bool shadows(int column, int row) const { return this->map->shadows(column, row, this->place); }
  /// Return the status by the map: true if the place's own texel says shadow.
  bool shadows() const { return this->shadows(this->place.column, this->place.row); }
  /// Return how many of the nine texels around say shadow.
  int votes() const;
  /// Return true if all texels of a neighbourhood give the same status.
  bool agree(Neighbourhood neighbourhood) const;
};

/// The triangle maps of all views of a light.
class TriangleMaps
{
public:
  /// Bake a map for each view.
  /// @param keptFromCentred for lights with a box, a plane (n, d) in centred coordinates; only
  /// parts of casters with n.p + d >= 0 count
  /// @throws TextureMemoryError without enough memory; there are no maps then
  void bake(const LightViews& views, int sizeTexels, const Occluders& occluders,
    const std::optional<glm::dvec4>& keptFromCentred);

  /// Return the place on the first map that holds it, the finest of splits. Without a place no
  /// caster can be between the light and the receiver, as views see all casters.
  std::optional<PlaceOnMaps> find(const glm::dvec3& origin, const glm::dvec3& normal) const;

  std::size_t bytes() const;

private:
  std::vector<TriangleMap> maps_;
};

} // namespace gnomon
