#pragma once

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/DepthBounds.h"
#include "shadowtech/depth_map/DepthMapTechnique.h"
#include "shadowtech/depth_map/KernelPoints.h"

#include <string>

namespace gnomon
{

/// `compare`: one comparison with the map, at the nearest texel (Williams 1978).
class Compare : public DepthMapTechnique
{
public:
  static TechniqueInfo info()
  {
    TechniqueInfo info;
    info.name = "compare";
    info.bytesPerTexel = bytesPerTexel;
    info.settings = { &viewSettings(), &depthMapSettings() };
    return info;
  }

protected:
  std::string estimatorGlsl(const ShadowLight&) const override
  {
    return ShaderLibrary::source("shadowtech/depth_map/compare_estimator.glsl");
  }
};

/// `pcf` and `adaptive`: the plain shadow map with percentage closer filtering (Reeves, Salesin and
/// Cook 1987; docs/techniques/pcf.md). Visibility is a weighted mean of comparisons with the texels
/// of the light's kernel, each made where its texel was sampled (DepthMapTechnique.h).
///
/// On warped maps, and with `kernel_width`, a kernel's size counts kernel units (Kernel.h).
/// Bilinear and castano weigh all texels in the kernel's shape; with `kernel_width` they use n x n
/// bilinear look-ups, a unit apart. Box, poisson and the disc read the texel at each of their
/// points.
///
/// Texels outside of the layer hold no casters, unless the kernel is larger than the border that
/// the view could reserve (half of the map at most). Then the layer's last texel stands in.
///
/// The jittered disc reads few texels where all of it is lit or hidden (Uralsky, GPU Gems 2,
/// chapter 17; Rzeczkowski, section 3.2.4). `early_out` `exact` compares the receiver's plane with
/// the least and the largest depth of blocks of the map around the point. Where the plane is in
/// front of all of a block's casters, or behind them, all of the disc's points agree. Blocks as
/// large as the disc come first. Within these, a plane's own depths may differ by more than the
/// map's push. So blocks of a quarter to half of that size follow.
class Pcf : public DepthMapTechnique
{
public:
  enum class Kernel
  {
    Chosen,      ///< by the setting `kernel`: `pcf`
    JitteredDisc ///< `adaptive`
  };
  explicit Pcf(Kernel kernel = Kernel::Chosen)
    : isDisc_(kernel == Kernel::JitteredDisc)
  {
  }
  static TechniqueInfo info(Kernel kernel)
  {
    TechniqueInfo info;
    if (kernel == Kernel::Chosen)
    {
      info.name = "pcf";
      info.bytesPerTexel = bytesPerTexel;
      info.settings = { &viewSettings(), &kernelSettings(), &pcfSettings(), &depthMapSettings() };
      info.refused = { refusedKernel };
      return info;
    }
    info.name = "adaptive";
    info.bytesPerTexel = bytesPerTexelWithBounds;
    info.settings = { &viewSettings(), &kernelSettings(), &adaptiveSettings(), &earlyOutSettings(),
      &depthMapSettings() };
    info.kernel = "disc";
    return info;
  }

  MapReach mapReach(const ShadowLight& light) const override
  {
    const KernelUnits units = kernelUnits(light);
    const double width = light.kernel.sizeTexels;
    if (this->isDisc_ || light.pcf.kernel == FilterKernel::Poisson)
    {
      return kernelReach(light, { 0.5, 0.0, 0.5 * width });
    }
    if (light.pcf.kernel == FilterKernel::Box)
    {
      return kernelReach(light, { 0.5, 0.5 * (width - 1.0), 0.0 });
    }
    return units == KernelUnits::Across ? kernelReach(light, { 1.0, 0.5 * (width - 1.0), 0.0 })
                                        : kernelReach(light, { 0.0, 0.5 * (width + 1.0), 0.0 });
  }

  void bake(const MapInput& input) override
  {
    this->DepthMapTechnique::bake(input);
    if (!this->isDisc_)
    {
      return;
    }
    const GlStateGuard guard;
    this->bakeDiscs(input.light.adaptive);
    this->bounds_.release();
    if (readsBounds(input.light))
    {
      this->bakeBounds(this->bounds_, input.shaders);
    }
  }

  std::size_t bytesOfMaps() const override
  {
    return this->DepthMapTechnique::bytesOfMaps() + this->bounds_.bytes() + this->discs_.bytes();
  }

  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override
  {
    std::vector<Uniform> uniforms = this->DepthMapTechnique::uniforms(space);
    if (this->isDisc_)
    {
      uniforms.push_back(
        { "discs_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->discs_.name() } });
    }
    if (this->bounds_)
    {
      uniforms.push_back(this->bounds_.uniform());
    }
    return uniforms;
  }

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override
  {
    const std::string source = ShaderLibrary::source("shadowtech/depth_map/pcf_estimator.glsl");
    const std::string common = kernelDefines(light) +
      glslDefine("PCF_TEXELS_LIGHT", light.kernel.sizeTexels) +
      glslDefine("PCF_DISC_LIGHT", this->isDisc_);
    if (this->isDisc_)
    {
      return common + glslDefine("DISC_RING_LIGHT", light.adaptive.discGrid) +
        glslDefine("DISC_POINTS_LIGHT", light.adaptive.discGrid * light.adaptive.discGrid) +
        glslDefine("DISC_SETS_LIGHT", light.adaptive.discSets) +
        glslDefine("DISC_ASKS_RING_LIGHT", light.earlyOut == EarlyOut::Ring) +
        glslDefine("DISC_ASKS_BOUNDS_LIGHT", readsBounds(light)) + source;
    }
    const KernelUnits units = kernelUnits(light);
    const bool poisson = light.pcf.kernel == FilterKernel::Poisson;
    const bool castano = light.pcf.kernel == FilterKernel::Castano;
    const bool smooth = castano || light.pcf.kernel == FilterKernel::Bilinear;
    const bool rows = light.pcf.kernel == FilterKernel::Bilinear && units == KernelUnits::Texels;
    const bool weighted = smooth && !rows && units != KernelUnits::Across;
    return common + glslDefine("PCF_ROWS_LIGHT", rows) +
      glslDefine("PCF_WEIGHTED_LIGHT", weighted) + glslDefine("PCF_POISSON_LIGHT", poisson) +
      glslDefine("PCF_POINTS_LIGHT", poissonPoints) +
      glslDefine("PCF_BOX_LIGHT", light.pcf.kernel == FilterKernel::Box) +
      glslDefine("PCF_CASTANO_LIGHT", castano) + (poisson ? poissonDiscGlsl() : "") +
      (castano ? castanoGlsl(light.kernel.sizeTexels) : "") + source;
  }

private:
  static std::string poissonDiscGlsl()
  {
    std::string points;
    for (const glm::dvec2& point : poissonDisc())
    {
      points += points.empty() ? "" : ", ";
      points += "vec2(" + std::to_string(point.x) + ", " + std::to_string(point.y) + ")";
    }
    return "const vec2 poissonDisc_LIGHT[" + std::to_string(poissonPoints) + "] = vec2[](" +
      points + ");\n";
  }

  /// Return the kernel's weights at 0, 1, 2, ... texels from the point, linear in between, and 0 at
  /// the end. Castano 2013 gives them as places and weights of bilinear look-ups.
  static std::string castanoGlsl(int texels)
  {
    const std::string weights = texels == 3 ? "2.0, 1.0, 0.0"
      : texels == 5                         ? "4.0, 3.0, 1.0, 0.0"
                                            : "16.0, 12.0, 5.0, 1.0, 0.0";
    return "const float castano_LIGHT[] = float[](" + weights + ");\n";
  }

  static std::string refusedKernel(const ShadowLight& light)
  {
    const int texels = light.kernel.sizeTexels;
    return light.pcf.kernel == FilterKernel::Castano && texels != 3 && texels != 5 && texels != 7
      ? "the kernel 'castano' has the sizes 3, 5 and 7, not " + std::to_string(texels)
      : "";
  }

  static bool readsBounds(const ShadowLight& light)
  {
    return light.earlyOut == EarlyOut::Exact && !measuresAlongRay(light);
  }

  void bakeDiscs(const AdaptiveSettings& settings)
  {
    const int sets = settings.discSets;
    const int points = settings.discGrid * settings.discGrid;
    if (!this->discs_.allocate({ GL_RG32F, GL_RG, 2 }, sets, sets, points, "a table of discs"))
    {
      return;
    }
    const int discs = sets * sets;
    const std::vector<glm::vec2> byDisc = jitteredDiscs(settings.discGrid, discs);
    std::vector<glm::vec2> byPoint;
    byPoint.reserve(byDisc.size());
    for (int point = 0; point < points; ++point)
    {
      for (int disc = 0; disc < discs; ++disc)
      {
        byPoint.push_back(byDisc[static_cast<std::size_t>(disc * points + point)]);
      }
    }
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage3D(
      GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, sets, sets, points, GL_RG, GL_FLOAT, byPoint.data());
  }

  bool isDisc_;
  ///@{
  /// Empty unless the kernel is the disc.
  SizedTexture discs_; ///< a layer for each point of the disc, a texel for each disc
  DepthBounds bounds_; ///< empty also unless `early_out` is exact
  ///@}
};

} // namespace gnomon
