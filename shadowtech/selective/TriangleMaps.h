#pragma once

#include "lights/LightViews.h"
#include "shadowtech/selective/TriangleMap.h"

#include <optional>
#include <vector>

namespace gnomon
{

/// Where a shadow ray lies on the maps of a light.
struct PlaceOnMaps
{
  const TriangleMap* map; ///< lives as long as the maps do
  MapPlace place;

  bool shadows(int column, int row) const { return this->map->shadows(column, row, this->place); }
  /// The status by the map: what the texel that holds the place says.
  bool shadows() const { return this->shadows(this->place.column, this->place.row); }
  /// How many of the nine texels around say that the receiver is in shadow.
  int votes() const;
  /// Whether all texels of a neighbourhood say the same.
  bool agree(Neighbourhood neighbourhood) const;
};

/// The triangle maps of all of a light's views.
class TriangleMaps
{
public:
  /// Draws the casters into a map per view.
  /// @param keptFromCentred of a light with a box: a plane (n, d) in centred coordinates; of
  /// casters, only what has n.p + d >= 0 counts
  /// @throws TextureMemoryError for maps without room; there are none then
  void bake(const LightViews& views, int sizeTexels, const Occluders& occluders,
    const std::optional<glm::dvec4>& keptFromCentred);

  /// The place on the first map that holds it, which of splits is the finest; nothing where no
  /// caster can be between the light and the receiver, as views see all casters.
  std::optional<PlaceOnMaps> find(const glm::dvec3& origin, const glm::dvec3& normal) const;

  std::size_t bytes() const;

private:
  std::vector<TriangleMap> maps_;
};

} // namespace gnomon
