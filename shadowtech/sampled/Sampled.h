#pragma once

#include "shadowtech/base/RunningSum.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/depth_map/Pcf.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon
{

/// `sampled`: soft shadows as the mean of the hard shadows of many points of the light, each from
/// its own depth map. Heckbert and Herf (1997) do so with projected casters instead of maps
/// (docs/techniques/sampled.md).
///
/// Maps are baked in batches. One shader compares each receiver with all maps of a batch, and adds
/// its visibility to a running sum of whole numbers below 2^24. (Splits that blend would add
/// fractions, so they are refused.) The sum is reused until one of its inputs changes. In
/// progressive mode, a frame after a change shows the hard shadow of the centre's map, which is
/// reused when the camera moves.
class Sampled : public GpuScreenTechnique
{
public:
  static TechniqueInfo info();

  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  void drawVisibility(const LayerInput& input, LightCounts& counts) override;

private:
  /// Points of a light with their colours in 255ths; with one channel the colour is 1.
  struct Points
  {
    std::vector<glm::dvec3> offsets; ///< from the light's centre
    std::vector<glm::vec3> shine;

    bool operator==(const Points& other) const
    {
      return this->offsets == other.offsets && this->shine == other.shine;
    }
  };

  /// The key of the sum. The key of the centre's map is separate.
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
  std::optional<Shown> shown_; ///< empty: the next frame restarts the sum
  std::vector<Compare> batch_; ///< the maps of a batch
  RunningSum sum_;
  std::size_t summed_ = 0; ///< number of points in the sum
};

} // namespace gnomon
