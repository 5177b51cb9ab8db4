#pragma once

#include "shadowtech/base/CasterDrawing.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <cstddef>
#include <utility>

namespace gnomon
{

/// The solid parts of casters in a light's map: up to four slabs per texel, between depths of ray
/// space (RaySpace.h).
///
/// RayLayers chooses the slabs (settings.json): between the nearest and the farthest
/// surface, or between peeled surfaces. The whole texel counts as what its centre sees.
class DepthLayers
{
public:
  /// Bake all views of a light.
  /// @param nearest the z at which p is -1, for positional lights
  void draw(const MapInput& input, double nearest)
  {
    const std::vector<LightView>& views = input.views.views;
    this->allocate(input.light, std::max(static_cast<int>(views.size()), 1));
    for (std::size_t view = 0; view < views.size(); ++view)
    {
      beginCasters(this->framebuffer_.name(), this->slabs_.width());
      isPeeled(input.light) ? this->drawPeeled(input, view, nearest)
                            : this->drawHull(input, view, nearest);
    }
  }

  /// Return an array of RGBA textures. A page holds two slabs (slabs.glsl); the pages of all views
  /// follow each other.
  GLuint slabs() const { return this->slabs_.name(); }
  int pages() const { return this->pages_; }
  std::size_t bytes() const
  {
    return this->slabs_.bytes() + this->layers_.bytes() + this->depth_.bytes();
  }

  /// of the map, for slabs and layers
  static double bytesPerTexel(const ShadowLight& light)
  {
    // All views' slabs, and the layers and the depth buffer that one view's slabs are peeled with.
    const int peeling = isPeeled(light) ? 4 * peeledSurfaces + 1 : 0;
    return sizeof(float) * (4.0 * mostViews(light) * pagesOf(light) + peeling);
  }

private:
  /// Number of peeled surfaces that face the light, and of those that face away.
  static constexpr int peeledSurfaces = 4;

  /// The cleared value of layers and slabs (slabs.glsl), behind all depths.
  static constexpr GLfloat noSurface[4] = { 2.0f, 2.0f, 2.0f, 2.0f };

  /// Return the shader that renders casters into a view's layer.
  static CasterShader layerShader(const char* path, const LightView& view, double nearest)
  {
    return { ShaderLibrary::source(path), { "DEPTH_LINEAR" },
      { { "nearest", static_cast<float>(view.depthScale * nearest) } } };
  }

  static bool isPeeled(const ShadowLight& light)
  {
    return light.monteCarlo.layers == RayLayers::Peeled;
  }

  static int pagesOf(const ShadowLight& light) { return isPeeled(light) ? 2 : 1; }

  void allocate(const ShadowLight& light, int views)
  {
    this->pages_ = pagesOf(light);
    const int side = light.mapSizeTexels;
    this->slabs_.allocateMap({ GL_RGBA32F, GL_RGBA, 4 }, side, views * this->pages_);
    if (isPeeled(light))
    {
      this->layers_.allocateMap({ GL_RG32F, GL_RG, 2 }, side, 2 * peeledSurfaces);
      this->depth_.allocateMap({ GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, 1 }, side, 1);
    }
    else
    {
      this->layers_.reset();
      this->depth_.reset();
    }
    glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, this->depth_.name(), 0, 0);
  }

  void drawHull(const MapInput& input, std::size_t view, double nearest)
  {
    glFramebufferTextureLayer(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->slabs_.name(), 0, static_cast<int>(view));
    glClearBufferfv(GL_COLOR, 0, noSurface);
    glDisable(GL_DEPTH_TEST);
    glEnablei(GL_BLEND, 0);
    glBlendEquation(GL_MIN);
    CasterShader shader =
      layerShader("shadowtech/montecarlo/layer_hull.frag.glsl", input.views.views[view], nearest);
    if (input.light.monteCarlo.layers == RayLayers::Near)
    {
      shader.defines.emplace_back("ENDLESS");
    }
    drawCasters(view, input, std::move(shader));
    glDisablei(GL_BLEND, 0);
  }

  void drawPeeled(const MapInput& input, std::size_t view, double nearest)
  {
    for (int layer = 0; layer < 2 * peeledSurfaces; ++layer)
    {
      const bool first = layer % peeledSurfaces == 0;
      glFramebufferTextureLayer(
        GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->layers_.name(), 0, layer);
      const GLfloat farthest = 1.0f;
      glClearBufferfv(GL_DEPTH, 0, &farthest);
      glClearBufferfv(GL_COLOR, 0, noSurface);
      CasterShader shader =
        layerShader("shadowtech/montecarlo/layer_peel.frag.glsl", input.views.views[view], nearest);
      shader.uniforms.push_back(
        { "layers", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->layers_.name() } });
      shader.uniforms.push_back({ "before", first ? -1 : layer - 1 });
      shader.uniforms.push_back({ "fronts", layer < peeledSurfaces ? 1 : 0 });
      drawCasters(view, input, std::move(shader));
    }
    const GLuint program = ScreenPass::use(input.shaders,
      ShaderLibrary::source("shadowtech/montecarlo/slabs_of_peeled.frag.glsl"),
      { "PEELED " + std::to_string(peeledSurfaces) });
    ShaderLibrary::setUniforms(
      program, { { "layers", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->layers_.name() } } }, 0, 0);
    std::vector<ScreenPass::Image> pages;
    for (int page = 0; page < this->pages_; ++page)
    {
      pages.push_back({ this->slabs_.name(), static_cast<int>(view) * this->pages_ + page });
    }
    this->screenPass_.fill(pages, this->slabs_.width(), this->slabs_.width());
  }

  SizedTexture slabs_;
  ///@{
  /// Of the view being peeled.
  SizedTexture layers_;
  SizedTexture depth_;
  ///@}
  GlFramebuffer framebuffer_;
  ScreenPass screenPass_;
  int pages_ = 0;
};

} // namespace gnomon
