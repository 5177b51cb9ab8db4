#pragma once

#include "lights/LightSamples.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/vtkGnomonPixelClass.h"
#include "shadowtech/tracing/TileVerdicts.h"
#include "shadowtech/tracing/TracedTiles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace gnomon
{

struct TracedTile;

/// The rays to an area light's samples that a pixel needs.
struct PixelSamples
{
  /// The number of lit samples if no ray is blocked.
  std::uint32_t lit = 0;
  /// How many of these its first ray stands for: all of them are dark if it is blocked. Each other
  /// ray stands for one.
  std::uint32_t ofFirstRay = 1;
  ///@{
  /// The samples of its rays, a range of SampleRays::samples.
  std::uint32_t first = 0, count = 0;
  ///@}
};

struct SampleRays
{
  std::vector<PixelSamples> pixels; ///< one for each pixel of a whole tile
  std::vector<std::uint32_t> samples;
};

/// Chooses, of a pixel's rays to an area light, the few that decide the others.
class SampleChooser
{
public:
  virtual ~SampleChooser() = default;

  /// Computes a pixel's rays to all samples, in their order, as they would be traced.
  using DirectionsOf =
    std::function<void(std::size_t pixel, const LightSamples::Coordinates& directions)>;

  /// Choose the rays of a tile. Called by several threads at once.
  /// @param tile its pixels that need a ray may get another class
  /// @param rays holds all rays of these pixels on entry
  /// @param again true if it has chosen for this tile, because a picture's rays are traced in
  /// parts. It must not count its statistics again
  virtual void choose(
    TracedTile& tile, const DirectionsOf& directionsOf, SampleRays& rays, bool again) const = 0;
};

/// How a pixel's visibility was decided, if rays are traced: indices into classesOfTracing(). A
/// receiver's class is what is known of it.
enum class TracedClass : std::uint8_t
{
  Traced = static_cast<std::uint8_t>(Certainty::Uncertain),
  Lit = static_cast<std::uint8_t>(Certainty::Lit),       ///< without a ray
  Shadow = static_cast<std::uint8_t>(Certainty::Shadow), ///< likewise
  /// Faces away from the light, or is outside its cone or box.
  Unreached = static_cast<std::uint8_t>(Certainty::Unreached),
  NoReceiver ///< no surface, or one that receives no shadows
};
/// Return the names and colours of the TracedClass values.
std::vector<PixelClass> classesOfTracing();

/// A pixel whose triangle is turned away from the light, while the curve above it is not.
struct TurnedPixel
{
  std::size_t pixel;    ///< of the tile
  std::size_t receiver; ///< index of its receiver
};

/// A tile of the picture: the pixels that need their shadow ray, and their visibility if it is not
/// blocked.
struct alignas(64) TracedTile
{
  static constexpr std::size_t columns = ReceiverTile::mostColumns;
  static constexpr std::size_t rows = ReceiverTile::mostRows;
  static constexpr std::size_t pixels = columns * rows;

  /// One number for each pixel of a whole tile, row by row.
  template <typename Number>
  using Plane = std::array<Number, pixels>;

  /// The shadow rays of all pixels, needed or not. Directions have any length.
  Plane<float> originX, originY, originZ;
  Plane<float> directionX, directionY, directionZ;
  Plane<int> needed; ///< 1 or 0; 0 beyond the picture's border
  ///@{
  /// The number of samples of the light that are seen, and the number that a blocked ray takes off.
  /// For a light with a texture, the sums of their colours in 255ths, channel by channel.
  std::array<Plane<float>, 3> visibility;
  std::array<Plane<float>, 3> samplesOfRay;
  ///@}
  Plane<std::uint8_t> classes;     ///< TracedClass
  const ReceiverPixels* receivers; ///< as in ReceiverTile
  std::vector<TurnedPixel> turned; ///< needed ones

  std::size_t channels;         ///< of the visibility: 1 or 3
  std::size_t number;           ///< index among the picture's tiles, row by row
  std::size_t firstPixel;       ///< index in the picture
  std::size_t columnsOfPicture; ///< width of the picture

  glm::vec3 origin(std::size_t pixel) const
  {
    return { this->originX[pixel], this->originY[pixel], this->originZ[pixel] };
  }
  glm::vec3 direction(std::size_t pixel) const
  {
    return { this->directionX[pixel], this->directionY[pixel], this->directionZ[pixel] };
  }
  std::size_t pixelOfPicture(std::size_t pixel) const
  {
    return this->firstPixel + pixel / columns * this->columnsOfPicture + pixel % columns;
  }
};

/// A picture's shadow rays for one light: the common part of EmbreeTracer and SharedTracer, which
/// only decide which rays are blocked. Each pixel has one ray to the light's centre, or one to each
/// of an area light's samples. Until finish(), visibility counts the rays that arrive.
class TracedPicture
{
public:
  /// A range of a pixel's rays, which nearly always are its samples.
  struct SampleRange
  {
    int first, end;
  };

  /// @param decider decides receivers without rays; null: all are traced. It is called once for a
  /// tile's pixels, however often the tile is visited
  /// @param visibility resized to one value per pixel of the picture; of several channels one image
  /// after the other
  /// @param classes if not null, resized to one per pixel
  /// @param tiles which tiles reuse visibility and classes; null: none
  /// @param verdicts what is known of tiles without rays; null: nothing. Must be null for textures
  /// @param samples of the light's area, and of its texture, if any; null: its centre
  /// @param chooser chooses the rays that decide the others; null: all are traced. Must be null for
  /// textures
  /// @param isColoured true for three channels without a texture
  TracedPicture(const ShadowLight& light, const Occluders& occluders, const Receivers& receivers,
    const ReceiverDecider* decider, std::vector<float>& visibility,
    std::vector<std::uint8_t>* classes, TracedTiles* tiles, const TileVerdicts* verdicts,
    const LightSamples* samples, const SampleChooser* chooser = nullptr, bool isColoured = false);

  /// Return the number of tiles, and of the picture's columns of pixels.
  std::size_t tiles() const;
  std::size_t columns() const { return this->receivers_.width(); }
  /// Return the far end of the rays, in lengths of their direction.
  float rayFar() const;
  const ShadowRayLight& light() const { return this->light_; }
  const Occluders& occluders() const { return this->occluders_; }

  /// Return the number of rays of a pixel that has any.
  int samples() const { return this->samples_ ? this->samples_->count() : 1; }
  bool isOfArea() const { return this->samples_ != nullptr; }
  SampleRange allSamples() const { return { 0, this->samples() }; }
  /// Return the channels of the visibility: 3 of an area light with a texture or a coloured filter,
  /// else 1.
  std::size_t channels() const { return this->texture_ || this->isColoured_ ? 3 : 1; }

  /// Fill visibility and classes, tile by tile, by several threads at once.
  /// @param samples the range of rays to trace; the range that begins at 0 also fills visibility
  /// and classes
  /// @param trace gets a tile with one ray per pixel that needs one, for each sample in turn; the
  /// first time with the visibility without rays. It may subtract samplesOfRay from the visibility
  /// of pixels whose ray is blocked, and returns the number of rays
  /// @return the sum of these numbers
  std::size_t visitTiles(
    const SampleRange& samples, const std::function<std::size_t(TracedTile&)>& trace) const;

  /// Subtract a blocked ray, which stands for one sample, from a pixel of a visited tile. For
  /// visibility of one channel.
  void darken(std::size_t pixel) const { this->visibility_[pixel] -= 1.0f; }

  /// Turn counts into shares, after all rays are traced.
  void finish() const;

private:
  const Certainty* certaintiesOf(const ReceiverTile& tile, const TracedTile& of) const;
  void fillDarkTiles() const;
  template <typename MakeRay>
  void prepare(const ReceiverTile& tile, const MakeRay& makeRay, TracedTile& traced) const;
  template <typename MakeRay>
  void findTurned(const ReceiverTile& tile, const MakeRay& makeRay, TracedTile& traced) const;
  std::size_t visitSamples(const SampleRange& samples, const ReceiverTile& tile, TracedTile& traced,
    const std::function<std::size_t(TracedTile&)>& trace) const;
  void keep(const ReceiverTile& tile, const TracedTile& traced) const;
  std::size_t pixels() const { return this->receivers_.width() * this->receivers_.height(); }
  void scale(std::size_t pixel, const glm::vec3& all) const;
  bool isKept(std::size_t tile) const { return this->tiles_ && this->tiles_->kept()[tile] != 0; }

  const Occluders& occluders_;
  const Receivers& receivers_;
  const ReceiverDecider* decider_;
  std::vector<float>& visibility_;
  std::vector<std::uint8_t>* classes_;
  TracedTiles* tiles_;
  const TileVerdicts* verdicts_;
  ShadowRayLight light_;
  const LightSamples* samples_;
  const PlacedTexture* texture_; ///< null: all samples count alike
  const SampleChooser* chooser_;
  bool isColoured_;
  /// The answers of verdicts and the decider for each tile's receivers, row by row; empty until
  /// they are asked. Null without any.
  std::unique_ptr<std::vector<Certainty>[]> certain_;
  /// The visibility of lit pixels, by channel, in the unit of TracedTile::visibility.
  std::array<float, 3> lit_;
  /// The divisors of the sums, laid out like `visibility_`; null without texture.
  std::unique_ptr<float[]> wholes_;
  /// By tile: 1 for tiles that are reused or known to be dark, whose receivers are not computed.
  std::vector<std::uint8_t> skipped_;
  /// By surface + 1, so that `notCovered` + 1 = 0 is the first: 1 if it receives, else 0.
  std::vector<std::uint8_t> receives_;
};

} // namespace gnomon
