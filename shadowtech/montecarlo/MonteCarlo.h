#pragma once

#include "lights/LightSamples.h"
#include "lights/LightViews.h"
#include "lights/SettingsTable.h"
#include "shadowtech/base/ChannelView.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/montecarlo/DepthLayers.h"
#include "shadowtech/montecarlo/RaySpace.h"
#include "shadowtech/montecarlo/SlabBounds.h"
#include "shadowtech/montecarlo/UndecidedTiles.h"
#include "shadowtech/montecarlo/VisibilityFilter.h"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace gnomon
{

/// `montecarlo`: soft shadows of area lights by a few random rays per pixel. A filter removes their
/// noise. The source is Curtis, *Real-Time Soft Shadows Using Monte Carlo Ray Tracing of Depth
/// Maps*, 2009.
///
/// Rays are traced through depth layers of the light's map. They do not meet triangles, but slabs
/// between two depths in a texel (DepthLayers.h). A hierarchy of bounds skips empty texels
/// (SlabBounds.h).
class MonteCarlo : public GpuScreenTechnique
{
public:
  static TechniqueInfo info()
  {
    TechniqueInfo info;
    info.name = "montecarlo";
    info.settings = { &viewSettings(), &lightSeedSettings(), &monteCarloSettings() };
    info.seesTextures = true;
    info.bytesPerTexel = [](const ShadowLight& light)
    { return DepthLayers::bytesPerTexel(light) + SlabBounds::bytesPerTexel(light); };
    info.bytesPerPixel = 64.0; // rays, means, weights, the filter's images
    info.refused = { refusedByMonteCarlo };
    info.classes = { { "no receiver", { 0, 0, 0 } },
      { "turned away from the light", { 0, 140, 60 } },
      { "lit by the map's bounds", { 230, 230, 230 } },
      { "in shadow by the map's bounds", { 90, 90, 90 } },
      { "decided by each ray's bounds", { 60, 160, 220 } }, { "searched", { 60, 60, 220 } } };
    return info;
  }

  ShadowLight lightOfMap(const ShadowLight& light) const override
  {
    return gnomon::lightOfMap(light);
  }

  void bake(const MapInput& input) override
  {
    const GlStateGuard guard;
    this->views_ = input.views;
    this->nearest_ = 1.0;
    for (LightView& view : this->views_.views)
    {
      if (view.rays.positional)
      {
        view.beginsAt = std::max(view.beginsAt, nearestOfArea(input.light));
        this->nearest_ = view.beginsAt; // faces of a cube begin at the same distance
      }
    }
    this->layers_.draw(
      { input.light, this->views_, input.occluders, input.buffers, input.shaders }, this->nearest_);
    this->bounds_.build(this->layers_.slabs(), this->layers_.pages(), input.light.mapSizeTexels,
      static_cast<int>(this->views_.views.size()), input.shaders);
  }

  std::size_t bytesOfMaps() const override
  {
    return this->layers_.bytes() + this->bounds_.bytes() + this->undecided_.bytes() +
      this->filter_.bytes() + this->unfiltered_.bytes() + this->slopes_.bytes() +
      this->lightTexture_.bytes();
  }

  void drawVisibility(const LayerInput& input, LightCounts& counts) override
  {
    const GlStateGuard guard;
    const ShadowLight& light = input.light;
    const int rays = raysOf(light);
    counts.lightSamples = rays * rays;
    this->allocate(input.receivers.width(), input.receivers.height(), channelsOf(info(), light));
    const bool textured = this->channels_ == 3;
    if (textured)
    {
      this->upload(light.texture->texture);
    }
    this->followRays(input);
    for (int channel = 0; channel < this->channels_ && filterOf(light) > 0; ++channel)
    {
      const ChannelView view = this->viewOf(channel);
      this->undecided_.find(this->unfiltered_, input.shaders);
      // A channel that the light lacks is 0 everywhere, without noise.
      const float mean = textured ? light.texture->mean[channel] : 1.0f;
      const float lit = mean > 0.0f ? mean : 1.0f;
      this->filter_.apply(input, input.layer + channel,
        { this->unfiltered_.name(), this->slopes_.name(), rays, lit }, this->undecided_,
        filterOf(light));
    }
    this->readClasses(input);
  }

private:
  /// Return the light's area; a point for lights without one.
  static LightArea areaOf(const ShadowLight& light) { return light.area.value_or(LightArea()); }

  /// Return the number of rays along each side of the grid on the light; 1 for a point.
  static int raysOf(const ShadowLight& light) { return light.area ? light.monteCarlo.rays : 1; }

  /// Return the filter's radius in pixels; 0 for hard shadows, which have no noise.
  static int filterOf(const ShadowLight& light) { return light.area ? light.monteCarlo.filter : 0; }

  static std::string refusedByMonteCarlo(const ShadowLight& light)
  {
    if (light.projection != Projection::Uniform && light.projection != Projection::Cube)
    {
      return "'montecarlo' traces rays through a map that holds all casters, and the projection '" +
        findSetting("projection")->get(light) +
        "' covers only what a camera sees; use uniform or cube";
    }
    const bool linear = light.monteCarlo.search == RaySearch::Linear;
    if (linear && light.monteCarlo.layers == RayLayers::Peeled)
    {
      return "'mc_search' linear needs at most one solid in a texel, and 'mc_layers' peeled has up "
             "to four; use near_far, near or eye";
    }
    if (!linear && light.monteCarlo.layers == RayLayers::Eye)
    {
      return "'mc_layers' eye asks the camera about single points of a ray, and 'mc_search' "
             "hierarchical has no such points; use linear";
    }
    return light.fit == ViewFit::Off
      ? ""
      : "'montecarlo' traces rays through a map that holds all casters, and one with 'fit' " +
        findSetting("fit")->get(light) + " covers only what a camera sees; use off";
  }

  void allocate(int width, int height, int channels)
  {
    const TexelFormat format =
      channels == 3 ? TexelFormat{ GL_RGBA32F, GL_RGBA, 4 } : TexelFormat{ GL_RG32F, GL_RG, 2 };
    this->unfiltered_.allocate(format, width, height, 0, "visibility");
    this->slopes_.allocate({ GL_RGBA32F, GL_RGBA, 4 }, width, height, 0, "slopes of visibility");
    this->channels_ = channels;
  }

  void upload(const std::shared_ptr<const LightTexture>& texture)
  {
    if (this->uploaded_ == texture)
    {
      return;
    }
    this->uploaded_.reset(); // stays empty if memory runs out
    this->lightTexture_.allocate({ GL_RGB8UI, GL_RGB_INTEGER, 3, GL_UNSIGNED_BYTE }, texture->width,
      texture->height, 0, "a light's texture");
    glBindTexture(GL_TEXTURE_2D, this->lightTexture_.name());
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, texture->width, texture->height, GL_RGB_INTEGER,
      GL_UNSIGNED_BYTE, texture->texels.data());
    this->uploaded_ = texture;
  }

  std::vector<Uniform> uniformsOf(const LayerInput& input) const
  {
    const ShadowLight& light = input.light;
    const glm::dmat4& viewFromCentred = input.camera.viewFromCentred;
    const glm::dmat4 centredFromView = glm::inverse(viewFromCentred);
    const glm::dvec3 centreWorld = input.occluders.frame.centre;
    std::vector<Uniform> uniforms = lightReachUniforms(light, centreWorld, viewFromCentred);
    const std::vector<Uniform> own = {
      { "receiverFragments", TextureBinding{ GL_TEXTURE_2D, input.receivers.fragments() } },
      { "receiverPoints", TextureBinding{ GL_TEXTURE_2D, input.receivers.points() } },
      { "slabs", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->layers_.slabs() } },
      { "slabBounds", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->bounds_.texture() } },
      { "topLevel", this->bounds_.topLevel() }, { "mapSide", light.mapSizeTexels },
      { "lightView", glm::vec4(viewFromCentred * lightPoint(light, centreWorld)) },
      { "pixelSide",
        glm::vec2(
          input.camera.pixelSide({ this->unfiltered_.width(), this->unfiltered_.height() })) },
      { "viewFromUnit", glm::mat3(glm::dmat3(viewFromCentred) * areaOf(light).worldFromUnit) },
      { "clipFromView", glm::mat4(input.camera.clipFromView) }, { "lightSeed", light.lightSeed },
      { "viewCount", static_cast<int>(this->views_.views.size()) }
    };
    uniforms.insert(uniforms.end(), own.begin(), own.end());
    if (this->channels_ == 3)
    {
      uniforms.push_back(
        { "lightTexture", TextureBinding{ GL_TEXTURE_2D, this->lightTexture_.name() } });
      uniforms.push_back({ "pictureFromView",
        glm::mat3(glm::dmat3(light.texture->pictureFromWorld) * glm::dmat3(centredFromView)) });
      uniforms.push_back({ "lit", light.texture->mean });
    }
    for (std::size_t i = 0; i < this->views_.views.size(); ++i)
    {
      const glm::dmat4 rayFromView =
        rayFromCentred(this->views_.views[i], light.mapSizeTexels, this->nearest_) *
        centredFromView;
      uniforms.push_back({ glslElement("rayFromView", i), glm::mat4(rayFromView) });
      uniforms.push_back({ glslElement("viewFromRay", i), glm::mat4(glm::inverse(rayFromView)) });
    }
    return uniforms;
  }

  /// Fill the light's layers and the inputs of the filter. If bounds decide pixels, a first pass
  /// does that, and a second traces rays in the tiles with undecided pixels.
  void followRays(const LayerInput& input)
  {
    const ShadowLight& light = input.light;
    const bool textured = this->channels_ == 3;
    std::vector<std::string> defines = lightReachDefines(light);
    defines.push_back("VIEWS " + std::to_string(mostViews(light)));
    defines.push_back("RAYS " + std::to_string(raysOf(light)));
    defines.push_back("SHAPE " + std::to_string(static_cast<int>(areaOf(light).shape)));
    defines.push_back("PAGES " + std::to_string(this->layers_.pages()));
    const auto defineWhere = [&](bool holds, const char* name)
    {
      if (holds)
      {
        defines.emplace_back(name);
      }
    };
    // Bounds cover one view, and a receiver's rays may cross several faces of a cube.
    const bool decides =
      light.monteCarlo.classify != RayClasses::Off && viewLayout(light) == ViewLayout::Single;
    defineWhere(textured, "TEXTURED");
    defineWhere(light.monteCarlo.search == RaySearch::Linear, "LINEAR_SEARCH");
    defineWhere(light.monteCarlo.layers == RayLayers::Eye, "EYE_LAYER");
    defineWhere(decides, "CLASSIFY_PIXELS");
    defineWhere(light.monteCarlo.classify == RayClasses::Rays, "CLASSIFY_RAYS");

    std::vector<ScreenPass::Image> images = { { this->unfiltered_.name() },
      { this->slopes_.name() } };
    for (int channel = 0; channel < this->channels_; ++channel)
    {
      images.push_back({ input.layers.texture(), input.layer + channel });
    }
    const std::string source = ShaderLibrary::source("shadowtech/montecarlo/montecarlo.frag.glsl");
    const std::vector<Uniform> uniforms = this->uniformsOf(input);
    const auto fill = [&](const std::vector<std::string>& all)
    {
      const GLuint program = ScreenPass::use(input.shaders, source, all);
      ShaderLibrary::setUniforms(program, uniforms, 0, 0);
      this->screenPass_.fill(images, this->unfiltered_.width(), this->unfiltered_.height());
    };
    if (!decides)
    {
      fill(defines);
      return;
    }
    std::vector<std::string> deciding = defines;
    deciding.emplace_back("DECIDES");
    fill(deciding);
    {
      const ChannelView view = this->viewOf(0);
      this->undecided_.find(this->unfiltered_, input.shaders);
    }
    const GLuint program = UndecidedTiles::use(input.shaders, source, defines);
    const int freeUnit = ShaderLibrary::setUniforms(program, uniforms, 0, 0);
    ShaderLibrary::setUniforms(program, this->undecided_.uniforms({ 0, 0 }), 0, freeUnit);
    this->undecided_.fill(images);
  }

  /// @param channel of visibility: 0, 1 or 2
  ChannelView viewOf(int channel) const
  {
    return ChannelView(this->unfiltered_.name(), GL_RED + static_cast<GLenum>(channel),
      this->channels_ == 3 ? GL_ALPHA : GL_GREEN);
  }

  void readClasses(const LayerInput& input) const
  {
    if (!input.classes)
    {
      return;
    }
    std::vector<glm::vec4> texels(static_cast<std::size_t>(this->unfiltered_.width()) *
      static_cast<std::size_t>(this->unfiltered_.height()));
    readTexture(this->unfiltered_.name(), GL_RGBA, GL_FLOAT, texels.data());
    input.classes->resize(texels.size());
    std::transform(texels.begin(), texels.end(), input.classes->begin(),
      [channel = this->channels_](const glm::vec4& texel)
      { return static_cast<std::uint8_t>(texel[channel]); }); // the class follows the channels
  }

  LightViews views_;
  double nearest_ = 0.0; ///< the z at which depths of ray space begin (RaySpace.h)
  DepthLayers layers_;
  SlabBounds bounds_;

  SizedTexture lightTexture_;
  std::shared_ptr<const LightTexture> uploaded_; ///< the texture in `lightTexture_`

  SizedTexture unfiltered_; ///< visibility in one channel or three, then the class
  SizedTexture slopes_;     ///< gradients of visibility
  UndecidedTiles undecided_;
  VisibilityFilter filter_;
  ScreenPass screenPass_;
  int channels_ = 1; ///< of visibility
};

} // namespace gnomon
