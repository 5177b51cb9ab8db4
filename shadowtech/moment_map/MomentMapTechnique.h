#pragma once

#include "lights/KernelShape.h"
#include "lights/SettingsTable.h"
#include "shadowtech/base/CasterDrawing.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/moment_map/BoxBlur.h"
#include "shadowtech/moment_map/SampledLayer.h"
#include "shadowtech/moment_map/SummedAreaTable.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <utility>

namespace gnomon
{

/// An estimator over moments.
struct MomentEstimator
{
  TechniqueInfo info;
  int count; ///< number of moments: 1, 2 or 4
  /// File of vec4 momentsOf(float depth, float spread). It returns mean moments of depths around
  /// `depth`, in [-1, 1], with standard deviation `spread`, in [0, 1]. Only the first `count`
  /// components count.
  const char* momentsFile;
  /// File of float estimate_LIGHT(ViewPoint point, float slack), which includes moment_map.glsl.
  const char* estimatorFile;
  glm::vec4 empty; ///< momentsOf(1, 0)
  /// A power of two that no moment exceeds in size, for fixed-point numbers; 0 if they cannot hold
  /// it.
  glm::vec4 largest;
};

/// The techniques with a map of moments, which is filtered before it is read
/// (docs/techniques/vsm.md). The filter is a box as wide as the light's kernel (BoxBlur.h), or one
/// rectangle per lookup with `blur` sat (SummedAreaTable.h). The texture unit's bilinear filter
/// adds to it. Together they are the bilinear kernel of `pcf` (Pcf.h).
///
/// The depth of moments is the map's linear depth, from [0, 1] to [-1, 1]. Texels without casters,
/// and those outside a layer, have the moments of depth 1.
///
/// No bias is tuned: docs/theory/moment_maps.md says why.
class MomentMapTechnique : public PointwiseTechnique
{
public:
  explicit MomentMapTechnique(MomentEstimator estimator)
    : estimator_(std::move(estimator))
  {
  }

  MapReach mapReach(const ShadowLight& light) const override
  {
    if (light.momentMap.blur == MapBlur::Sat)
    {
      // Along each axis the rectangle extends as far as a disc would.
      return kernelReach(light, { 0.5, 0.0, 0.5 * light.kernel.sizeTexels });
    }
    return { 0.5 * (light.kernel.sizeTexels + 1.0), 0.0 };
  }

  void bake(const MapInput& input) override
  {
    const GlStateGuard guard;
    const std::vector<LightView>& views = input.views.views;
    this->summed_ = input.light.momentMap.blur == MapBlur::Sat;
    // Even a light without a view needs a texture to bind.
    this->allocate(input.light, std::max(static_cast<int>(views.size()), 1));
    this->views_ = input.views;
    this->viewFits_ = input.viewFits;
    this->reach_ = this->mapReach(input.light);
    if (this->summed_)
    {
      this->table_.setUnits(this->estimator_.largest, this->widestKernel());
    }

    const int samples = input.light.momentMap.samples;
    const bool sampled = samples > 1;
    const GLuint target = sampled ? this->sampled_.framebuffer() : this->framebuffer_.name();
    beginCasters(target, this->map_.width());
    if (sampled)
    {
      glEnable(GL_MULTISAMPLE);
    }
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      const auto view = static_cast<int>(i);
      glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.name());
      glFramebufferTextureLayer(
        GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->map_.name(), 0, this->summed_ ? 0 : view);
      glBindFramebuffer(GL_FRAMEBUFFER, target);
      const float farthest = 1.0f;
      glClearBufferfv(GL_DEPTH, 0, &farthest);
      glClearBufferfv(GL_COLOR, 0, glm::value_ptr(this->estimator_.empty));
      std::vector<std::string> defines = { "DEPTH_LINEAR", "SAMPLES " + std::to_string(samples) };
      if (!views[i].depthIsAffine())
      {
        defines.emplace_back("WRITES_DEPTH");
      }
      drawCasters(i, input,
        { ShaderLibrary::source(this->estimator_.momentsFile) +
            ShaderLibrary::source("shadowtech/moment_map/moment_map_bake.frag.glsl"),
          defines });
      if (sampled)
      {
        this->sampled_.average(this->framebuffer_.name());
      }
      if (this->summed_)
      {
        this->table_.sum(this->map_.name(), 0, view, input.shaders);
      }
    }
    if (!this->summed_ && input.light.kernel.sizeTexels > 1)
    {
      this->blur_.apply(this->map_.name(), static_cast<int>(views.size()),
        input.light.kernel.sizeTexels, this->estimator_.empty, input.shaders);
    }
    if (this->map_.levels() > 1)
    {
      // Drivers may use either path to read the blur's output.
      glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
      glActiveTexture(GL_TEXTURE0);
      glBindTexture(GL_TEXTURE_2D_ARRAY, this->map_.name());
      glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
    }
  }

  std::size_t bytesOfMaps() const override
  {
    return this->map_.bytes() + this->depth_.bytes() + this->sampled_.bytes() +
      this->blur_.bytes() + this->table_.bytes();
  }

  std::string visibilityGlsl(const ShadowLight& light) const override
  {
    return lightViewsDefines(light, light.momentMap.mipMaps) + kernelDefines(light) +
      glslDefine("KERNEL_TEXELS_LIGHT", light.kernel.sizeTexels) +
      glslDefine("MOMENT_LEVELS_LIGHT", levelsOf(light)) +
      glslDefine("MOMENTS_SUMMED_LIGHT", light.momentMap.blur == MapBlur::Sat) +
      glslDefine("BLEEDING_LIGHT", light.momentMap.bleeding) +
      glslDefine("VARIANCE_FLOOR_LIGHT", light.variance.floor) +
      ShaderLibrary::source(this->estimator_.estimatorFile);
  }

  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override
  {
    std::vector<Uniform> uniforms =
      lightViewsUniforms(this->views_, this->map_.width(), space, this->viewFits_);
    uniforms.push_back(depthSlacks());
    if (!this->summed_)
    {
      uniforms.push_back(
        { "momentMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->map_.name() } });
      return uniforms;
    }
    const std::vector<Uniform> table = this->table_.uniforms(this->estimator_.empty);
    uniforms.insert(uniforms.end(), table.begin(), table.end());
    uniforms.push_back({ "widestKernel_LIGHT", static_cast<float>(this->widestKernel()) });
    uniforms.push_back(kernelUnit(this->reach_));
    return uniforms;
  }

private:
  static TexelFormat momentsFormat(int moments)
  {
    return moments == 1 ? TexelFormat{ GL_R32F, GL_RED, 1 }
      : moments == 2    ? TexelFormat{ GL_RG32F, GL_RG, 2 }
                        : TexelFormat{ GL_RGBA32F, GL_RGBA, 4 };
  }

  /// Return the number of levels of a light's map: down to a single texel, or 1 without mip maps.
  static int levelsOf(const ShadowLight& light)
  {
    int levels = 1;
    while (light.momentMap.mipMaps && light.mapSizeTexels >> levels > 0)
    {
      ++levels;
    }
    return levels;
  }

  void allocate(const ShadowLight& light, int views)
  {
    const TexelFormat format = momentsFormat(this->estimator_.count);
    const int sizeTexels = light.mapSizeTexels;
    const bool blurred = !this->summed_ && light.kernel.sizeTexels > 1;
    blurred ? this->blur_.allocate(format, sizeTexels) : this->blur_.release();
    this->summed_ ? this->table_.allocate(format.channels, sizeTexels, views)
                  : this->table_.release();
    const int levels = levelsOf(light);
    if (this->map_.allocateMap(format, sizeTexels, this->summed_ ? 1 : views, levels))
    {
      glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER,
        levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
      glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
      glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
      glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
      glTexParameterfv(
        GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BORDER_COLOR, glm::value_ptr(this->estimator_.empty));
    }
    if (light.momentMap.samples > 1)
    {
      this->depth_.reset();
      this->sampled_.allocate(format, sizeTexels, light.momentMap.samples);
    }
    else
    {
      this->sampled_.release();
      this->depth_.allocateMap({ GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, 1 }, sizeTexels, 1);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, this->depth_.name(), 0, 0);
  }

  /// Return the longest side of a rectangle that lookups read from the baked map, in texels.
  double widestKernel() const
  {
    const double texelsAcross = mostTexelsAcross(this->views_, this->map_.width());
    return std::clamp(
      2.0 * this->reach_.largestTexels(texelsAcross) - 1.0, 1.0, 2.0 * this->map_.width());
  }

  MomentEstimator estimator_;
  SizedTexture map_;   ///< a layer per view; with summed-area tables, one layer before it is summed
  SizedTexture depth_; ///< of the layer being baked, with one sample per texel
  GlFramebuffer framebuffer_;
  SampledLayer sampled_; ///< the layer being baked, if it has several samples per texel
  BoxBlur blur_;
  SummedAreaTable table_;
  MapReach reach_;          ///< as baked
  bool summed_ = false;     ///< as baked
  LightViews views_;        ///< as baked
  TextureBinding viewFits_; ///< as baked
};

} // namespace gnomon
