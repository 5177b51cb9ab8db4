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
/// a depth map of its own (Heckbert and Herf 1997 from shadow maps instead of projected casters;
/// docs/techniques/sampled.md).
///
/// Maps are drawn a batch at a time, and one shader compares each receiver with all maps of the
/// batch and adds what it sees to a running sum, in whole numbers below 2^24. (Splits that blend
/// would add others; they are refused.) The sum is kept while nothing changes that it depends on.
/// In progressive mode the hard shadow that a change shows at once comes from the centre's map,
/// which outlives the camera's moves.
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
