#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

/// The tiles of a picture, 16 x 16 pixels each, with pixels that bounds do not decide. Later passes
/// render only these tiles. The vertex shader drops all others, so nothing is read back. Skipping
/// tiles is needed because software OpenGL runs both sides of a branch.
class UndecidedTiles
{
public:
  /// Find the tiles.
  /// @param visibilityAndClass an image of pixels, x: visibility, y: class (classes.glsl)
  void find(const SizedTexture& visibilityAndClass, ShaderLibrary& shaders)
  {
    this->size_ = { visibilityAndClass.width(), visibilityAndClass.height() };
    this->contents_.allocate({ GL_RGBA32F, GL_RGBA, 4 }, tilesOf(this->size_.x),
      tilesOf(this->size_.y), 0, "what there is in tiles");
    const GLuint program = ScreenPass::use(shaders,
      ShaderLibrary::source("shadowtech/montecarlo/undecided_tiles.frag.glsl"), { tileDefine() });
    ShaderLibrary::setUniforms(program,
      { { "visibilityAndClass", TextureBinding{ GL_TEXTURE_2D, visibilityAndClass.name() } } }, 0,
      0);
    this->screenPass_.fill(
      { { this->contents_.name() } }, this->contents_.width(), this->contents_.height());
  }

  /// Build and use the program that runs a fragment shader in the tiles. The define MIXED skips
  /// tiles near which all receivers that face the light have the same visibility.
  static GLuint use(ShaderLibrary& shaders, const std::string& fragmentGlsl,
    const std::vector<std::string>& defines)
  {
    std::vector<std::string> all = defines;
    all.push_back(tileDefine());
    return ScreenPass::use(shaders,
      ShaderLibrary::source("shadowtech/montecarlo/undecided_tiles.vert.glsl"), fragmentGlsl, all);
  }

  /// Return the uniforms that the program needs beside the fragment shader's.
  /// @param reachTiles how many tiles around an undecided one are rendered, too, along x and y
  std::vector<Uniform> uniforms(const glm::ivec2& reachTiles) const
  {
    return { { "tiles", TextureBinding{ GL_TEXTURE_2D, this->contents_.name() } },
      { "pictureSize", this->size_ }, { "reachTiles", reachTiles } };
  }

  void fill(const std::vector<ScreenPass::Image>& images)
  {
    this->screenPass_.fillQuads(
      images, this->size_.x, this->size_.y, this->contents_.width() * this->contents_.height());
  }

  /// Return how many tiles cover a distance in pixels.
  static int tilesOf(int pixels) { return (pixels + tileSide - 1) / tileSide; }

  std::size_t bytes() const { return this->contents_.bytes(); }

private:
  static constexpr int tileSide = 16; // pixels

  static const std::string& tileDefine()
  {
    static const std::string define = "TILE_PIXELS " + std::to_string(tileSide);
    return define;
  }

  SizedTexture contents_; ///< output of undecided_tiles.frag.glsl
  ScreenPass screenPass_;
  glm::ivec2 size_{ 0 }; ///< of the picture, in pixels
};

} // namespace gnomon
