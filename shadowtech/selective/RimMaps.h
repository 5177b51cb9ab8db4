#pragma once

#include "lights/LightAt.h"
#include "lights/LightSpace.h"
#include "lights/LightViews.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/selective/TriangleMaps.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon
{

/// Triangle maps of points around an area light, in addition to its centre's. If all of them give a
/// receiver the same status, it counts for the whole light.
class RimMaps
{
public:
  /// Drop all maps, after casters or settings changed.
  void clear() { this->points_.clear(); }
  /// Bake the maps whose views changed.
  /// @param light must have an area
  /// @param fitting of the centre's views
  /// @param points number of points around the light
  /// @return the number of maps baked
  /// @throws TextureMemoryError without enough memory
  int update(const ShadowLight& light, const ViewFitting& fitting, const Occluders& occluders,
    std::size_t points)
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

  /// Return true if the texels of all points' maps confirm a receiver's status.
  ///
  /// Points behind the receiver's plane are not tested, as their opposites replace them
  /// (directionToSample()). If the light has a texture, that changes the colour of unhidden
  /// receivers. So no receiver whose plane cuts a textured light counts as lit.
  /// @param origin where the receiver's shadow rays start, centred
  /// @param normal of the receiver, on the camera's side
  /// @param toCentre from the receiver to the light's centre; of length 1 for directional lights
  /// @param inShadow the status to confirm
  bool agree(const glm::dvec3& origin, const glm::vec3& normal, const glm::vec3& toCentre,
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

  std::size_t bytes() const
  {
    return bytesOfAll(this->points_, [](const Point& point) { return point.maps.bytes(); });
  }

private:
  struct Point
  {
    glm::vec3 offset; ///< from the light's centre
    LightViews views;
    TriangleMaps maps;
  };
  /// Return true if the light has a texture, and part of its area is behind the receiver's plane.
  /// @param toCentre to the light, which the receiver faces
  bool cutsTexture(const glm::vec3& normal, const glm::vec3& toCentre) const
  {
    return this->textured_ &&
      !facesLight(
        normal, toCentre - static_cast<float>(this->textured_->extentAlong(normal)) * normal);
  }

  std::vector<Point> points_;
  std::optional<LightArea> textured_; ///< the light's area; empty without a texture
};

} // namespace gnomon
