#pragma once

#include "shadowtech/base/RunningSum.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/depth_map/Compare.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon
{

/// The most points whose maps are held at a time: one shader reads all of them.
constexpr int mostBatchSamples = 8;

struct SampledSettings
{
  int batch = mostBatchSamples; ///< points whose maps are held at a time
  /// Points that each frame adds while nothing changes, the first one showing the hard shadow of
  /// the centre; 0: all are in every frame.
  int progressive = 0;
};
const SettingsTable& sampledSettings();

/// `sampled`: soft shadows as the mean of the hard ones that many points of the light cast, each by
/// a depth map of its own (Heckbert and Herf 1997 from shadow maps instead of projected casters).
///
/// Maps are drawn a batch at a time, and one shader compares each receiver with all maps of the
/// batch and adds what it sees to a running sum. Sums are whole numbers below 2^24, which floats
/// hold: neither the batches' size nor the frames that the points are spread over change a bit of
/// the mean. (Splits that blend would; they are refused.)
///
/// Visibility means what it means to shadow rays (sideOfSample): a point behind the receiver's
/// plane gives way to the opposite one. Points come in opposite pairs (pairedLightSamples), so that
/// this is a matter of weights: a point counts twice where the receiver faces it and not its
/// opposite. A pair's weights always sum to 2, so that a pair is the least that may be shown.
///
/// Of a light with a texture the sum has three channels: each point counts with its colour
/// (LightTexture.h). A few points seldom have the texture's mean, and so the sum is divided by what
/// makes theirs the mean: of what nothing hides the light from, visibility is the mean.
///
/// The sum is kept while nothing changes that it depends on: then nothing more is drawn. In
/// progressive mode a change shows the centre's hard shadow, from the centre's map, which outlives
/// the camera's moves, and each further frame adds points, from the middle of the light outwards.
/// (Of a light with a texture the hard shadow is that of a point at the centre that has the
/// texture's mean, as the sum shows it.)
class Sampled : public GpuScreenTechnique
{
public:
  static TechniqueInfo info();

  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  void drawVisibility(const LayerInput& input, LightReport& report) override;

private:
  /// Points of a light, and what each of them shines with: its colour in 255ths, of one channel 1.
  struct Points
  {
    std::vector<glm::dvec3> offsets; ///< from the light's centre
    std::vector<glm::vec3> shine;

    bool operator==(const Points& other) const
    {
      return this->offsets == other.offsets && this->shine == other.shine;
    }
  };

  /// What the sum was made for, beside what makes the centre's map stale.
  struct Shown
  {
    std::size_t receivers = 0; ///< LayerInput::receiversShown
    Points points;             ///< pairedLightSamples()
    int channels = 1;          ///< channelsOf()

    bool operator==(const Shown& other) const
    {
      return this->receivers == other.receivers && this->points == other.points &&
        this->channels == other.channels;
    }
  };

  std::size_t progressiveIn(const LayerInput& input) const;
  bool beginIfStale(const LayerInput& input);
  void beginSum(const LayerInput& input);
  void addBatch(
    const LayerInput& input, const Points& points, std::size_t first, std::size_t count);
  std::string sumGlsl(const LayerInput& input, const std::vector<ShadowLight>& lights) const;
  void showMean(const LayerInput& input, const glm::vec3& shine);
  void showCentre(const LayerInput& input);

  Compare centre_;
  std::optional<Shown> shown_; ///< none: the next frame begins anew
  std::vector<Compare> batch_; ///< the maps that are held at a time
  RunningSum sum_;
  std::size_t summed_ = 0; ///< points in the sum
};

} // namespace gnomon
