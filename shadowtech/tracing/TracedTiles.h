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

/// By how much a box of triangles or receivers is larger than they are, as a share of the largest
/// coordinate: rays and their hits are computed in float.
inline constexpr double floatNoise = 1.0 / 131072.0; // 2^-17

/// Where rays from one box to a light pass: the convex hull of the box and one around the light, or
/// what a box sweeps along all of a directional light's directions.
class SweptBox
{
public:
  /// @param from centred; not empty
  /// @param light of any kind, with its area
  SweptBox(const Bounds& from, const ShadowLight& light, const glm::dvec3& centreWorld);

  /// Whether it and a box have a point in common.
  bool meets(const Bounds& centred) const;

private:
  Bounds from_;
  /// The box at t goes from from_.lower + t lower to from_.upper + t upper.
  glm::dvec3 lower_, upper_;
  double last_; ///< the greatest t
};

/// What a light's visibility image was traced from, tile by tile, so that the next image need not
/// be traced where nothing has changed: a tile keeps its visibility if its pixels show the same
/// triangles, and if no surface that moved was or is in the tile, or between it and the light.
///
/// The image is that of one camera, one light and one list of surfaces. If one of them changes, or
/// the number of the light's samples, the image is traced as a whole.
class TracedTiles
{
public:
  /// Forgets all: the next image is traced as a whole.
  void forget();

  /// Begins an image: finds the tiles that keep the visibility of the image before.
  /// @param before the fragments of the image before, if all else than the places of surfaces is as
  /// it was then; null: the image is traced as a whole
  void begin(const Occluders& occluders, const ShadowLight& light, const ReceiverImages& images,
    const std::vector<glm::vec2>* before);

  /// By tile, row by row: 1 for those that keep their visibility.
  const std::vector<std::uint8_t>& kept() const { return this->kept_; }

  /// Takes note of the receivers of a tile that is traced, which are all there. Several threads
  /// may do so at once, for different tiles.
  void note(const ReceiverTile& tile);

  std::size_t bytes() const;

private:
  /// Where a surface is.
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
  /// By tile, around its receivers and the starts of their rays; without end if that is not known,
  /// or if a receiver may start elsewhere once something moves (ReceiverPixels::isBlocked).
  std::vector<Bounds> boxes_;
  std::vector<std::uint8_t> kept_;
};

} // namespace gnomon
