#include "shadowtech/selective/RimMaps.h"

#include "lights/LightAt.h"
#include "lights/LightSpace.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/ShadowRay.h"

#include <algorithm>

namespace gnomon
{

//------------------------------------------------------------------------------
int RimMaps::update(const ShadowLight& light, const ViewFitting& fitting,
  const Occluders& occluders, std::size_t points)
{
  this->textured_ = light.texture ? light.area : std::nullopt;
  const std::vector<glm::dvec3> offsets = rimOf(*light.area, points);
  if (this->points_.size() != points)
  {
    this->points_ = std::vector<Point>(points);
  }
  // Casters outside the centre's box cast nothing.
  const std::optional<glm::dvec4> begins =
    light.box ? std::optional(nearFaceCentred(light, fitting.centreWorld)) : std::nullopt;
  int drawn = 0;
  for (std::size_t i = 0; i < points; ++i)
  {
    Point& point = this->points_[i];
    point.offset = offsets[i];
    LightViews views = fitLightViews(lightAt(light, offsets[i], fitting), fitting);
    if (point.views == views)
    {
      continue;
    }
    point.views = {}; // stays empty if memory runs out
    point.maps.bake(views, light.mapSizeTexels, occluders, begins);
    point.views = std::move(views);
    ++drawn;
  }
  return drawn;
}

//------------------------------------------------------------------------------
bool RimMaps::agree(const glm::dvec3& origin, const glm::vec3& normal, const glm::vec3& toCentre,
  Neighbourhood neighbourhood, bool inShadow) const
{
  if (!inShadow && this->cutsTexture(normal, toCentre))
  {
    return false;
  }
  return std::all_of(this->points_.begin(), this->points_.end(),
    [&](const Point& point)
    {
      if (!facesLight(normal, toCentre + point.offset))
      {
        return true;
      }
      const std::optional<PlaceOnMaps> place = point.maps.find(origin, normal);
      return place ? place->shadows() == inShadow && place->agree(neighbourhood) : !inShadow;
    });
}

//------------------------------------------------------------------------------
bool RimMaps::cutsTexture(const glm::vec3& normal, const glm::vec3& toCentre) const
{
  return this->textured_ &&
    !facesLight(
      normal, toCentre - static_cast<float>(this->textured_->extentAlong(normal)) * normal);
}

//------------------------------------------------------------------------------
std::size_t RimMaps::bytes() const
{
  return bytesOfAll(this->points_, [](const Point& point) { return point.maps.bytes(); });
}

} // namespace gnomon
