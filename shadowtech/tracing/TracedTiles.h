#pragma once

#include "lights/Bounds.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The growth of boxes of triangles or receivers, as a share of the largest coordinate, because
/// rays and their hits are computed in float.
inline constexpr double floatNoise = 1.0 / 131072.0; // 2^-17

/// The region of rays from a box to a light: the convex hull of the box and a box around the light,
/// or the sweep of the box along all of a directional light's directions.
class SweptBox
{
public:
  /// @param from centred; not empty
  /// @param light of any kind, with its area
  SweptBox(const Bounds& from, const ShadowLight& light, const glm::dvec3& centreWorld);

  /// True if the region and a box have a common point.
  bool meets(const Bounds& centred) const;

private:
  Bounds from_;
  /// The box at t goes from from_.lower + t lower to from_.upper + t upper.
  glm::dvec3 lower_, upper_;
  double last_; ///< the greatest t
};

/// The inputs of a light's traced visibility image, tile by tile, so that the next image reuses
/// unchanged tiles. A tile is reused if its pixels show the same triangles, and if no moved surface
/// was or is in the tile, or between it and the light.
///
/// The image is that of one camera, one light and one list of surfaces. If one of them changes, or
/// the number of the light's samples, the whole image is traced.
class TracedTiles
{
public:
  /// Forget all: the next image is traced as a whole.
  void forget();

  /// Begin an image: find the tiles that reuse the visibility of the last image.
  /// @param before the fragments of the last image, if only places of surfaces have changed since;
  /// null: the image is traced as a whole
  void begin(const Occluders& occluders, const ShadowLight& light, const ReceiverImages& images,
    const std::vector<glm::vec2>* before);

  /// Return, by tile, row by row, 1 if the tile reuses its visibility.
  const std::vector<std::uint8_t>& kept() const { return this->kept_; }

  /// Record the receivers of a traced tile, which are all there. Several threads may call this at
  /// once, for different tiles.
  void note(const ReceiverTile& tile);

  std::size_t bytes() const;

private:
  struct Place
  {
    std::uint64_t positionsVersion;
    Bounds centred;
  };
  std::vector<Bounds> movedSince(const Occluders& occluders) const;

  std::size_t tilesAcross_ = 0;
  int lightSamples_ = 0;
  std::uint64_t topologyVersion_ = 0;
  glm::dvec3 centreWorld_{ 0.0 };
  std::vector<Place> places_; ///< by surface
  /// By tile, the box around its receivers and the starts of their rays; infinite if unknown.
  std::vector<Bounds> boxes_;
  std::vector<std::uint8_t> kept_;
};

} // namespace gnomon
