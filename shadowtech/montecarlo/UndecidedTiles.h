#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
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
  void find(const SizedTexture& visibilityAndClass, ShaderLibrary& shaders);

  /// Build and use the program that runs a fragment shader in the tiles. The define MIXED skips
  /// tiles near which all receivers that face the light have the same visibility.
  static GLuint use(ShaderLibrary& shaders, const std::string& fragmentGlsl,
    const std::vector<std::string>& defines);
  /// Return the uniforms that the program needs beside the fragment shader's.
  /// @param reachTiles how many tiles around an undecided one are rendered, too, along x and y
  std::vector<Uniform> uniforms(const glm::ivec2& reachTiles) const;
  /// Render the tiles into the images.
  void fill(const std::vector<ScreenPass::Image>& images);

  /// Return how many tiles cover a distance in pixels.
  static int tilesOf(int pixels);

  std::size_t bytes() const { return this->contents_.bytes(); }

private:
  SizedTexture contents_; ///< output of undecided_tiles.frag.glsl
  ScreenPass screenPass_;
  glm::ivec2 size_{ 0 }; ///< of the picture, in pixels
};

} // namespace gnomon
