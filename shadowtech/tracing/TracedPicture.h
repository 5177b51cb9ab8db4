#pragma once

#include "lights/LightSamples.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/vtkGnomonPixelClass.h"
#include "shadowtech/tracing/SampleRays.h"
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

/// How a pixel comes to its visibility where rays are traced: indices into classesOfTracing().
enum class TracedClass : std::uint8_t
{
  Traced,
  Lit,       ///< for certain, without a ray
  Shadow,    ///< the same
  Unreached, ///< turned away from the light, or outside its cone or box
  NoReceiver ///< nothing is seen, or what receives no shadow
};
std::vector<PixelClass> classesOfTracing();

/// A tile of the picture: which of its pixels need their shadow ray, and what they show unless it
/// is blocked.
struct alignas(64) TracedTile
{
  static constexpr std::size_t columns = ReceiverTile::mostColumns;
  static constexpr std::size_t rows = ReceiverTile::mostRows;
  static constexpr std::size_t pixels = columns * rows;

  /// One number for each pixel of a whole tile, row by row.
  template <typename Number>
  using Plane = std::array<Number, pixels>;

  /// The shadow rays of all pixels, needed or not. Their direction has any length.
  Plane<float> originX, originY, originZ;
  Plane<float> directionX, directionY, directionZ;
  Plane<int> needed; ///< 1 or 0; 0 beyond the picture's border
  ///@{
  /// How many of the light's samples are seen, and how many of them a blocked ray takes off; of a
  /// light with a texture the sums of their colours in 255ths, channel by channel.
  std::array<Plane<float>, 3> visibility;
  std::array<Plane<float>, 3> samplesOfRay;
  ///@}
  Plane<std::uint8_t> classes; ///< TracedClass

  std::size_t channels;         ///< of the visibility: 1 or 3
  std::size_t number;           ///< of the picture's tiles, row by row
  std::size_t firstPixel;       ///< of the picture
  std::size_t columnsOfPicture; ///< from a row of the picture to the next

  /// The picture's pixel that one of the tile's is.
  std::size_t pixelOfPicture(std::size_t pixel) const
  {
    return this->firstPixel + pixel / columns * this->columnsOfPicture + pixel % columns;
  }
};

/// A picture's shadow rays in one light: what the tracers have in common is here, and which rays
/// are blocked is theirs to say. Each pixel has one to the light's centre, or one to each of an
/// area light's samples. Until finish(), visibility counts those that arrive.
class TracedPicture
{
public:
  /// Some of a pixel's rays, one after another: nearly always its samples.
  struct SampleRange
  {
    int first, end;
  };

  /// @param decider decides receivers without rays; null: all are traced. It is asked about a
  /// tile's pixels once, however often the tile is visited
  /// @param visibility resized to one for each pixel of the picture; of several channels one image
  /// after the other
  /// @param classes where not null, resized to one for each pixel
  /// @param tiles which of them keep what visibility and classes hold; null: none
  /// @param verdicts what is known of tiles without rays; null: nothing. Lights with textures have
  /// none
  /// @param samples of the light's area, which it has a texture with if any; null: its centre
  /// @param chooser who knows which of a pixel's rays decide the others; null: nobody. There is
  /// none for textures
  TracedPicture(const ShadowLight& light, const Occluders& occluders, const Receivers& receivers,
    const ReceiverDecider* decider, std::vector<float>& visibility,
    std::vector<std::uint8_t>* classes, TracedTiles* tiles, const TileVerdicts* verdicts,
    const LightSamples* samples, const SampleChooser* chooser = nullptr);

  /// How many tiles it has.
  std::size_t tiles() const;
  /// Where the rays end, in lengths of their direction.
  float rayFar() const;

  /// How many rays a pixel has, if any.
  int samples() const { return this->samples_ ? this->samples_->count() : 1; }
  SampleRange allSamples() const { return { 0, this->samples() }; }
  /// Of its visibility: 3 of an area light with a texture, else 1.
  std::size_t channels() const { return this->texture_ ? 3 : 1; }

  /// Fills visibility and classes, tile by tile; several threads do so at once.
  /// @param samples whose rays are traced; visibility and classes are filled with the first of them
  /// all
  /// @param trace gets a tile with one ray for each pixel that needs one, for all samples in turn;
  /// at first as it shows without any. It may take samplesOfRay off the visibility of pixels whose
  /// ray is blocked, and returns the number of rays
  /// @return the sum of those
  std::size_t visitTiles(
    const SampleRange& samples, const std::function<std::size_t(TracedTile&)>& trace) const;

  /// Takes a blocked ray off a pixel of a tile that was visited.
  /// @param samples that the ray stands for, one number for each channel
  void darken(std::size_t pixel, const float* samples) const
  {
    for (std::size_t channel = 0; channel < this->channels(); ++channel)
    {
      this->visibility_[channel * this->pixels() + pixel] -= samples[channel];
    }
  }

  /// Makes shares of counts, once all rays are traced.
  void finish() const;

private:
  const Certainty* certaintiesOf(const ReceiverTile& tile, std::size_t number) const;
  void fillDarkTiles() const;
  template <typename MakeRay>
  void prepare(const ReceiverTile& tile, const MakeRay& makeRay, TracedTile& traced) const;
  std::size_t visitSamples(const SampleRange& samples, const ReceiverTile& tile, TracedTile& traced,
    const std::function<std::size_t(TracedTile&)>& trace) const;
  void keep(const ReceiverTile& tile, const TracedTile& traced) const;
  std::size_t pixels() const { return this->receivers_.width() * this->receivers_.height(); }
  void scale(std::size_t pixel, const glm::vec3& all) const;
  bool isKept(std::size_t tile) const { return this->tiles_ && this->tiles_->kept()[tile] != 0; }

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
  /// What verdicts and the decider have said of each tile's receivers, row by row; empty where they
  /// were not asked yet. Null without any.
  std::unique_ptr<std::vector<Certainty>[]> certain_;
  /// What is lit, by channel, in the unit of TracedTile::visibility.
  std::array<float, 3> lit_;
  /// What the sums are divided by, as `visibility_` is laid out; null without texture.
  std::unique_ptr<float[]> wholes_;
  /// By tile: 1 for those that are kept or known to be dark, whose receivers are not asked for.
  std::vector<std::uint8_t> skipped_;
  /// By surface + 1, so that `notCovered` + 1 = 0 is the first: 1 or 0.
  std::vector<std::uint8_t> receives_;
};

} // namespace gnomon
