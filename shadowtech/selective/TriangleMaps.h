#pragma once

#include "lights/LightViews.h"
#include "shadowtech/selective/TriangleMap.h"

#include <optional>
#include <vector>

namespace gnomon
{

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
