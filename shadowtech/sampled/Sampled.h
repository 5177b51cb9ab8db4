#pragma once

#include "lights/LightAt.h"
#include "lights/LightSamples.h"
#include "lights/LightSpace.h"
#include "lights/SettingsTable.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/ChannelView.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/RunningSum.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/depth_map/Pcf.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
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
  static TechniqueInfo info()
  {
    TechniqueInfo info;
    info.name = "sampled";
    info.settings = { &viewSettings(), &lightSampleSettings(), &lightSeedSettings(),
      &sampledSettings(), &depthMapSettings() };
    info.seesTextures = true;
    info.bytesPerTexel = [](const ShadowLight& light)
    { return (1.0 + light.sampled.batch) * Compare::bytesPerTexel(light); };
    info.bytesPerPixel = 32.0; // two sums of four channels
    info.refused = { refusedBySampled, refusedSamples };
    return info;
  }

  void bake(const MapInput& input) override
  {
    this->shown_.reset();
    this->centre_.bake(input);
  }

  std::size_t bytesOfMaps() const override
  {
    return this->centre_.bytesOfMaps() + this->sum_.bytes() +
      bytesOfAll(this->batch_, &Compare::bytesOfMaps);
  }

  void drawVisibility(const LayerInput& input, LightCounts& counts) override
  {
    const GlStateGuard guard;
    const bool stale = this->beginIfStale(input);
    const Points& points = this->shown_->points;
    const std::size_t all = points.offsets.size();
    const std::size_t progressive = this->progressiveIn(input);
    const bool begins = stale && all > 1 && progressive > 0;
    if (begins || (all == 1 && this->shown_->channels == 1))
    {
      this->showCentre(input);
      counts.lightSamples = 1;
      counts.progress = begins ? 0.0 : 1.0;
      return;
    }
    const auto most = static_cast<std::size_t>(input.light.sampled.batch);
    if (this->batch_.size() > most)
    {
      this->batch_.clear(); // frees their memory
    }
    const std::size_t wanted = pairedPointsWanted(all, this->summed_, progressive);
    while (this->summed_ < wanted)
    {
      const std::size_t count = std::min(wanted - this->summed_, most);
      this->addBatch(input, points, this->summed_, count);
      this->summed_ += count;
    }
    this->showMean(input, shineOf(points.shine, 0, this->summed_));
    counts.lightSamples = static_cast<int>(this->summed_);
    counts.progress = static_cast<double>(this->summed_) / static_cast<double>(all);
  }

private:
  /// The number in the identifiers of the centre's shader. The points of a batch follow.
  static constexpr int centreNumber = 0;

  static int numberOf(std::size_t pointOfBatch)
  {
    return centreNumber + 1 + static_cast<int>(pointOfBatch);
  }

  /// Return the sum of the colours of some points.
  static glm::vec3 shineOf(const std::vector<glm::vec3>& shine, std::size_t first, std::size_t end)
  {
    const auto begin = shine.begin();
    return std::accumulate(begin + static_cast<std::ptrdiff_t>(first),
      begin + static_cast<std::ptrdiff_t>(end), glm::vec3(0.0f));
  }

  /// Return the offset, in texels, by which the map of a light's point is moved. A scene's box
  /// stays in place on the maps of a directional or a small light. Without an offset, all of them
  /// would round an edge to the same texels. Penumbrae would then have steps as wide as texels.
  ///
  /// The offsets are Roberts' R2 sequence (The Unreasonable Effectiveness of Quasirandom Sequences,
  /// 2018). The first point's map stays in place.
  static glm::dvec2 moveOfMap(std::size_t point)
  {
    const glm::dvec2 step(0.7548776662466927, 0.5698402909980532); // 1/g, 1/g^2, g^3 = g + 1
    return glm::fract(0.5 + static_cast<double>(point) * step) - 0.5;
  }

  static std::string refusedBySampled(const ShadowLight& light)
  {
    if (light.projection != Projection::Uniform && light.projection != Projection::Cube)
    {
      return "'sampled' supports the projections uniform and cube, not '" +
        findSetting("projection")->get(light) +
        "', as all points of the light must see what its centre reaches";
    }
    return light.area && light.lightSampling == LightSampling::Jittered
      ? "'sampled' needs points in opposite pairs, which a grid of cells lacks; its "
        "'light_sampling' is sobol or random"
      : "";
  }

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

  /// Return how many points this frame may add; 0 for all. The sum belongs to one view.
  std::size_t progressiveIn(const LayerInput& input) const
  {
    const int progressive = input.light.sampled.progressive;
    if (progressive > 0 && input.severalViews)
    {
      input.notes.push_back(nameOf(input.light) +
        ": 'progressive' refines a single view, and the pass renders several (stereo, tiles, "
        "renderers), so every frame computes all points of the light");
      return 0;
    }
    return static_cast<std::size_t>(progressive);
  }

  /// Restart the sum if it is stale.
  /// @return true if it was
  bool beginIfStale(const LayerInput& input)
  {
    Shown shown{ input.receiversShown, { pairedLightSamples(input.light), {} },
      channelsOf(info(), input.light) };
    const bool textured = shown.channels == 3;
    for (const glm::dvec3& point : shown.points.offsets)
    {
      shown.points.shine.push_back(
        textured ? input.light.texture->colourAt(point) : glm::vec3(1.0f));
    }
    if (this->shown_ && *this->shown_ == shown)
    {
      return false;
    }
    if (const int channels = textured ? 4 : 1; this->sum_.channels() != channels)
    {
      this->sum_ = RunningSum(channels);
    }
    this->shown_.reset(); // stays empty if memory runs out
    this->beginSum(input);
    this->shown_ = std::move(shown);
    return true;
  }

  void beginSum(const LayerInput& input)
  {
    this->sum_.begin(
      input.receivers.width(), input.receivers.height(), "the sum of a light's points");
    this->summed_ = 0;
  }

  /// Bake the maps of some points, and add their visibility to the sum.
  void addBatch(const LayerInput& input, const Points& points, std::size_t first, std::size_t count)
  {
    const ShadowLight& light = input.light;
    if (this->batch_.size() < count)
    {
      this->batch_ = std::vector<Compare>(count);
    }
    ViewFitting fitting = input.fitting;
    ++fitting.texels.border; // room for the maps' offsets
    std::vector<ShadowLight> lights;
    for (std::size_t i = 0; i < count; ++i)
    {
      lights.push_back(lightAt(light, points.offsets[first + i], fitting));
      LightViews views = fitLightViews(lights[i], fitting);
      moveTexels(views, moveOfMap(first + i), fitting.texels.side);
      MapInput map{ lights[i], views, input.occluders, input.buffers, input.shaders };
      if (light.box)
      {
        map.keptFromCentred = nearFaceCentred(light, input.fitting.centreWorld);
      }
      this->batch_[i].bake(map);
      ++input.mapBakes;
    }

    const bool textured = this->shown_->channels == 3;
    const std::vector<std::string> defines =
      textured ? std::vector<std::string>{ "TEXTURED" } : std::vector<std::string>{};
    const GLuint program = ScreenPass::use(input.shaders, this->sumGlsl(input, lights), defines);
    std::vector<Uniform> uniforms = this->sum_.before();
    uniforms.push_back(
      { "receiverFragments", TextureBinding{ GL_TEXTURE_2D, input.receivers.fragments() } });
    uniforms.push_back(
      { "receiverPoints", TextureBinding{ GL_TEXTURE_2D, input.receivers.points() } });
    const glm::vec3 shine = shineOf(points.shine, first, first + count);
    uniforms.push_back(
      textured ? Uniform{ "batchShine", shine } : Uniform{ "batchShine", shine.r });
    int freeUnit = ShaderLibrary::setUniforms(program, uniforms, centreNumber, 0);
    freeUnit = ShaderLibrary::setUniforms(
      program, this->centre_.uniforms(input.space), centreNumber, freeUnit);
    const glm::dmat3 lightFromWorld(lightFromCentred(light, input.fitting.centreWorld));
    for (std::size_t i = 0; i < count; ++i)
    {
      std::vector<Uniform> ofPoint = this->batch_[i].uniforms(input.space);
      ofPoint.push_back(
        { "pointOffset_LIGHT", glm::vec3(lightFromWorld * points.offsets[first + i]) });
      ofPoint.push_back({ "pointShine_LIGHT", points.shine[first + i] });
      freeUnit = ShaderLibrary::setUniforms(program, ofPoint, numberOf(i), freeUnit);
    }
    this->sum_.fill();
  }

  /// Return the shader that compares receivers with the maps of these lights.
  std::string sumGlsl(const LayerInput& input, const std::vector<ShadowLight>& lights) const
  {
    std::string text = numberedForLight(this->centre_.visibilityGlsl(input.light), centreNumber);
    std::string sum;
    const std::string share = ShaderLibrary::source("shadowtech/sampled/sampled_share.glsl");
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
      text += numberedForLight(this->batch_[i].visibilityGlsl(lights[i]) + share, numberOf(i));
      sum += (sum.empty() ? "" : " + ") + std::string("share_") + std::to_string(numberOf(i)) +
        "(positionView, normalView, normalCentre, toCentre)";
    }
    text += "Shine sharesOfBatch(vec3 positionView, vec3 normalView, vec3 normalCentre, vec3 "
            "toCentre)\n{\n  return " +
      sum + ";\n}\n";
    return text +
      numberedForLight(
        ShaderLibrary::source("shadowtech/sampled/sampled_sum.frag.glsl"), centreNumber);
  }

  /// Fill the layers with the mean.
  /// @param shine sum of the colours of the points in the sum
  void showMean(const LayerInput& input, const glm::vec3& shine)
  {
    const int channels = this->shown_->channels;
    const GLuint program = ScreenPass::use(
      input.shaders, ShaderLibrary::source("shadowtech/sampled/sampled_mean.frag.glsl"));
    for (int channel = 0; channel < channels; ++channel)
    {
      const float lit = channels == 3 ? input.light.texture->mean[channel] : 1.0f;
      // The sum of a colour that no point has is 0.
      const float whole = shine[channel] > 0.0f ? shine[channel] / lit : 1.0f;
      const ChannelView view(this->sum_.texture(), GL_RED + static_cast<GLenum>(channel), GL_GREEN);
      ShaderLibrary::setUniforms(program,
        { { "sum", TextureBinding{ GL_TEXTURE_2D, this->sum_.texture() } }, { "whole", whole } },
        centreNumber, 0);
      input.layers.fill(input.layer + channel);
    }
  }

  /// Fill the layers with the centre's hard shadow. The sum is empty before and after.
  void showCentre(const LayerInput& input)
  {
    if (this->shown_->channels == 1)
    {
      input.layers.estimate(
        input.layer, this->centre_, input.light, input.receivers, input.space, input.shaders);
      return;
    }
    const Points centre{ { glm::dvec3(0.0) }, { input.light.texture->mean } };
    this->addBatch(input, centre, 0, 1);
    this->showMean(input, centre.shine[0]);
    this->beginSum(input);
  }

  Compare centre_;
  std::optional<Shown> shown_; ///< empty: the next frame restarts the sum
  std::vector<Compare> batch_; ///< the maps of a batch
  RunningSum sum_;
  std::size_t summed_ = 0; ///< number of points in the sum
};

} // namespace gnomon
