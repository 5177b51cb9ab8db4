#pragma once

#include "lights/LightView.h"
#include "lights/LightViews.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/mesh/CasterBands.h"
#include "shadowtech/mesh/CasterShapes.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <cmath>
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
    int sizeTexels, const Occluders& occluders)
    : size_(sizeTexels)
    , texels_(static_cast<std::size_t>(sizeTexels) * static_cast<std::size_t>(sizeTexels))
  {
    const CasterScene scene = casterScene(view, keptFromCentred.has_value(), sizeTexels, occluders);
    this->mapFromCentred_ = scene.space.mapFromCentred(scene.space.depthOffset - farthestDepth);
    this->planeFromCentred_ = glm::transpose(glm::inverse(this->mapFromCentred_));
    MapDrawing(scene, keptFromCentred, this->mapFromCentred_, sizeTexels, this->texels_.data());
  }

  /// Return where a shadow ray starts on the map; nothing if that is outside.
  /// @param origin where it starts, centred
  /// @param normal of its receiver, on the camera's side
  std::optional<MapPlace> placeOf(const glm::dvec3& origin, const glm::dvec3& normal) const
  {
    const glm::dvec4 point = this->mapFromCentred_ * glm::dvec4(origin, 1.0);
    const double perW = 1.0 / point.w;
    MapPlace place;
    place.x = point.x * perW;
    place.y = point.y * perW;
    place.depth = point.z * perW;
    const double size = this->size_;
    // NaN must fail. Points without positive W are behind a positional light.
    if (!(point.w > 0.0 && place.x >= 0.0 && place.x < size && place.y >= 0.0 && place.y < size))
    {
      return std::nullopt;
    }
    place.column = static_cast<int>(place.x);
    place.row = static_cast<int>(place.y);
    place.plane = this->planeFromCentred_ * glm::dvec4(normal, -glm::dot(normal, origin));
    return place;
  }

  /// Return a texel; an empty one outside the map.
  const TriangleTexel& texel(int column, int row) const
  {
    static const TriangleTexel empty;
    const bool inside = column >= 0 && row >= 0 && column < this->size_ && row < this->size_;
    return inside
      ? this->texels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(this->size_) +
          static_cast<std::size_t>(column)]
      : empty;
  }

  /// Return true if the caster at a texel's centre hides a receiver, as far as the map can tell.
  /// Two conditions must hold:
  /// - the caster's plane passes between the receiver and the light;
  /// - at the centre, the caster lies before the receiver's plane, even if pushed back. The push is
  ///   its largest change of depth on the way to the receiver's place.
  ///
  /// No bias is tuned. A triangle meets neither condition for its own points. Where a surface is
  /// convex, neighbours lie behind the receiver's plane. Where it is concave, the receiver lies
  /// before theirs. Only surfaces that are both within a texel remain.
  bool shadows(int column, int row, const MapPlace& place) const
  {
    const TriangleTexel& texel = this->texel(column, row);
    if (!texel.caster.exists())
    {
      return false;
    }
    const double x = column + 0.5;
    const double y = row + 0.5;
    const double perColumn = texel.perColumn;
    const double perRow = texel.perRow;
    const double depth = texel.depth;
    const double alongRow = perColumn * (place.x - x);
    const double alongColumn = perRow * (place.y - y);
    const double slack = depthRounding * (std::abs(depth) + std::abs(perColumn) + std::abs(perRow));
    const bool isBefore = depth + alongRow + alongColumn < place.depth - slack;
    const double deepest = depth + std::abs(alongRow) + std::abs(alongColumn);
    const bool isAbove = glm::dot(place.plane, glm::dvec4(x, y, deepest, 1.0)) > 0.0;
    return isBefore && isAbove;
  }

  std::size_t bytes() const { return bytesOf(this->texels_); }

private:
  /// Bounds rounding of depths on a plane to float, over their magnitude and their change per
  /// texel: four times half a unit in the last place.
  static constexpr double depthRounding = 2.384185791015625e-7; // 2^-22

  /// Depths count from the farthest caster. A light among its casters has depths in proportion to
  /// -1 / distance, so float is finest where most of them are.
  static constexpr double farthestDepth = 1.0;

  /// A polygon's plane, clamped to its corners' depths, as slivers may exceed them by rounding.
  struct BoundedPlane
  {
    MapPlane plane;
    double least, most; ///< depths of the corners

    explicit BoundedPlane(const MapPolygon& polygon)
      : plane(planeOf(polygon))
      , least(polygon.corners[0].depth)
      , most(least)
    {
      for (std::size_t i = 1; i < polygon.count; ++i)
      {
        this->least = std::min(this->least, polygon.corners[i].depth);
        this->most = std::max(this->most, polygon.corners[i].depth);
      }
    }

    double depthAt(double x, double y) const
    {
      return std::clamp(this->plane.depthAt(x, y), this->least, this->most);
    }
  };

  /// Return the columns of a row whose centres lie in a convex polygon; none if first > last.
  static Span columnsOf(const MapPolygon& polygon, double y, int size)
  {
    double low = static_cast<double>(size);
    double high = 0.0;
    for (std::size_t i = 0; i < polygon.count; ++i)
    {
      const MapCorner* a = &polygon.corners[i];
      const MapCorner* b = &polygon.corners[(i + 1) % polygon.count];
      if (a->y > b->y)
      {
        std::swap(a, b); // neighbours must cut their common edge at the same place
      }
      if (a->y <= y && y < b->y)
      {
        const double x = a->x + (y - a->y) / (b->y - a->y) * (b->x - a->x);
        low = std::min(low, x);
        high = std::max(high, x);
      }
    }
    const auto firstFrom = [size](double x)
    { return static_cast<int>(std::ceil(std::clamp(x - 0.5, 0.0, static_cast<double>(size)))); };
    return { firstFrom(low), firstFrom(high) - 1 };
  }

  /// A map being baked.
  class MapDrawing
  {
  public:
    MapDrawing(const CasterScene& scene, const std::optional<glm::dvec4>& keptFromCentred,
      const glm::dmat4& mapFromCentred, int size, TriangleTexel* texels)
      : scene_(scene)
      , kept_(keptFromCentred)
      , centredFromMap_(glm::inverse(mapFromCentred))
      , size_(size)
      , texels_(texels)
      , placements_(scene.occluders)
      , triangles_(size)
    {
      this->sort();
      visitBands(size, [this](int band, Span rows) { this->drawBand(band, rows); });
    }

  private:
    MapPolygon polygonOf(const Placement& placement, std::uint32_t triangle) const
    {
      MapPolygon polygon = gnomon::polygonOf(
        this->scene_, this->placements_.surfaceOf(placement), placement.instance, triangle);
      for (std::size_t i = 0; i < polygon.count; ++i)
      {
        polygon.corners[i].depth -= farthestDepth;
      }
      return polygon;
    }

    void sort()
    {
      this->placements_.visitTriangles(
        [&](std::uint32_t number, std::uint32_t triangle)
        {
          const MapPolygon polygon = this->polygonOf(this->placements_[number], triangle);
          if (polygon.role.present && polygon.count >= 3)
          {
            const auto [low, high] = polygon.rows();
            this->triangles_.add(low, high, { number, triangle });
          }
        });
    }

    void drawBand(int band, Span rows)
    {
      this->triangles_.visit(band,
        [&](const BandItem& item)
        {
          const Placement& placement = this->placements_[item.placement];
          this->draw({ placement.surface, placement.instance, item.index },
            this->polygonOf(placement, item.index), rows);
        });
    }

    void draw(const CasterTriangle& caster, const MapPolygon& polygon, const Span& rows)
    {
      const BoundedPlane plane(polygon);
      const Surface& surface = this->scene_.occluders.surfaces[caster.surface];
      for (int row = rows.first; row <= rows.last && plane.plane.area != 0.0; ++row)
      {
        const double y = row + 0.5;
        const Span columns = columnsOf(polygon, y, this->size_);
        TriangleTexel* const texels =
          this->texels_ + static_cast<std::ptrdiff_t>(row) * this->size_;
        for (int column = columns.first; column <= columns.last; ++column)
        {
          const double x = column + 0.5;
          const double depth = plane.depthAt(x, y);
          TriangleTexel& texel = texels[column];
          const auto rounded = static_cast<float>(depth);
          // Break ties by number, so that the order of threads does not matter.
          const bool nearer = rounded < texel.depth ||
            (rounded == texel.depth && texel.caster.exists() && caster < texel.caster);
          const bool looksCloser = nearer && (this->kept_ || surface.cutout);
          if (nearer && (!looksCloser || this->blocksAt(caster, surface, { x, y, depth })))
          {
            texel = { caster, rounded, static_cast<float>(plane.plane.perX),
              static_cast<float>(plane.plane.perY) };
          }
        }
      }
    }

    /// Return true if a triangle blocks light at one of its points: inside the light's box, and not
    /// in a hole.
    bool blocksAt(
      const CasterTriangle& caster, const Surface& surface, const MapCorner& point) const
    {
      const glm::dvec4 homogeneous =
        this->centredFromMap_ * glm::dvec4(point.x, point.y, point.depth, 1.0);
      const glm::dvec3 centred = glm::dvec3(homogeneous) / homogeneous.w;
      if (this->kept_ && glm::dot(*this->kept_, glm::dvec4(centred, 1.0)) < 0.0)
      {
        return false;
      }
      if (!surface.cutout)
      {
        return true;
      }
      const auto [a, b, c] =
        centredCorners(this->scene_.occluders, surface, caster.instance, caster.triangle);
      const glm::dvec3 area = glm::cross(b - a, c - a);
      const double perArea = 1.0 / glm::dot(area, area);
      const double ofB = glm::dot(glm::cross(centred - a, c - a), area) * perArea;
      const double ofC = glm::dot(glm::cross(b - a, centred - a), area) * perArea;
      const glm::uvec3 corners =
        this->scene_.occluders.triangles[caster.triangle] - surface.firstVertex;
      const auto at = [&](unsigned int corner)
      { return glm::dvec2(surface.textureCoordinates[corner]); };
      return surface.cutout->isDrawn(glm::vec2(at(corners.x) +
        ofB * (at(corners.y) - at(corners.x)) + ofC * (at(corners.z) - at(corners.x))));
    }

    const CasterScene& scene_;
    const std::optional<glm::dvec4>& kept_;
    glm::dmat4 centredFromMap_;
    int size_;
    TriangleTexel* texels_;
    CasterPlacements placements_;
    CasterBands triangles_;
  };

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
  int votes() const
  {
    int votes = 0;
    visitNeighbourhood(Neighbourhood::Nine, this->place,
      [&](int column, int row)
      {
        votes += this->shadows(column, row) ? 1 : 0;
        return false;
      });
    return votes;
  }

  /// Return true if all texels of a neighbourhood give the same status.
  bool agree(Neighbourhood neighbourhood) const
  {
    const bool first = this->shadows();
    return !visitNeighbourhood(neighbourhood, this->place,
      [&](int column, int row) { return this->shadows(column, row) != first; });
  }
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
    const std::optional<glm::dvec4>& keptFromCentred)
  {
    this->maps_.clear(); // frees the old maps' memory first
    requireRoomForMap(sizeof(TriangleTexel), sizeTexels, static_cast<int>(views.views.size()));
    for (const LightView& view : views.views)
    {
      this->maps_.emplace_back(view, keptFromCentred, sizeTexels, occluders);
    }
  }

  /// Return the place on the first map that holds it, the finest of splits. Without a place no
  /// caster can be between the light and the receiver, as views see all casters.
  std::optional<PlaceOnMaps> find(const glm::dvec3& origin, const glm::dvec3& normal) const
  {
    for (const TriangleMap& map : this->maps_)
    {
      if (const std::optional<MapPlace> place = map.placeOf(origin, normal))
      {
        return PlaceOnMaps{ &map, *place };
      }
    }
    return std::nullopt;
  }

  std::size_t bytes() const { return bytesOfAll(this->maps_, &TriangleMap::bytes); }

private:
  std::vector<TriangleMap> maps_;
};

} // namespace gnomon
