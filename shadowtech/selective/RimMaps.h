#pragma once

#include "lights/LightViews.h"
#include "lights/ShadowLight.h"
#include "shadowtech/selective/TriangleMaps.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon
{

/// Triangle maps that points around an area light see, as well as its centre: where all of them say
/// the same of a receiver, it is taken to be so for all of the light.
class RimMaps
{
public:
  /// Forgets the maps, because casters or settings have changed.
  void clear() { this->points_.clear(); }
  /// Draws the maps whose views have changed.
  /// @param light with an area
  /// @param fitting that of the centre's views
  /// @param points how many
  /// @return how many points' maps were drawn
  /// @throws TextureMemoryError for maps without room
  int update(const ShadowLight& light, const ViewFitting& fitting, const Occluders& occluders,
    std::size_t points);

  /// Whether the texels of all points' maps say this of a receiver. A point behind the receiver's
  /// plane is not asked, since it gives way to the opposite one (directionToSample()). Where the
  /// light has a texture, that changes the colour of what nothing hides the light from: no map says
  /// of a receiver whose plane cuts the light that it is lit.
  /// @param origin where the receiver's shadow rays start, centred
  /// @param normal of the receiver, on the camera's side
  /// @param toCentre from the receiver to the light's centre; of a directional light of length 1
  bool agree(const glm::dvec3& origin, const glm::vec3& normal, const glm::vec3& toCentre,
    Neighbourhood neighbourhood, bool inShadow) const;

  std::size_t bytes() const;

private:
  struct Point
  {
    glm::vec3 offset; ///< from the light's centre
    LightViews views;
    TriangleMaps maps;
  };
  /// Whether a receiver's plane has some of the light behind it and some in front.
  /// @param toCentre the light's, which the receiver faces
  bool cutsTexture(const glm::vec3& normal, const glm::vec3& toCentre) const;

  std::vector<Point> points_;
  std::optional<LightArea> textured_; ///< the light's area, if it has a texture
};

} // namespace gnomon
