#include "shadowtech/selective/TriangleMaps.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/TextureMemory.h"

namespace gnomon
{

//------------------------------------------------------------------------------
int PlaceOnMaps::votes() const
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

//------------------------------------------------------------------------------
bool PlaceOnMaps::agree(Neighbourhood neighbourhood) const
{
  const bool first = this->shadows();
  return !visitNeighbourhood(neighbourhood, this->place,
    [&](int column, int row) { return this->shadows(column, row) != first; });
}

//------------------------------------------------------------------------------
void TriangleMaps::bake(const LightViews& views, int sizeTexels, const Occluders& occluders,
  const std::optional<glm::dvec4>& keptFromCentred)
{
  this->maps_.clear(); // frees the old maps' memory first
  requireRoomForMap(sizeof(TriangleTexel), sizeTexels, static_cast<int>(views.views.size()));
  for (const LightView& view : views.views)
  {
    this->maps_.emplace_back(view, keptFromCentred, sizeTexels, occluders);
  }
}

//------------------------------------------------------------------------------
std::optional<PlaceOnMaps> TriangleMaps::find(
  const glm::dvec3& origin, const glm::dvec3& normal) const
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

//------------------------------------------------------------------------------
std::size_t TriangleMaps::bytes() const
{
  return bytesOfAll(this->maps_, &TriangleMap::bytes);
}

} // namespace gnomon
