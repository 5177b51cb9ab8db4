#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

/// The tiles of a picture, 16 x 16 pixels each, that have pixels which bounds do not decide. Passes
/// that are for these pixels draw these tiles alone: the vertex shader drops all others, so that
/// nothing is read back. Software OpenGL runs both sides of a branch, so a branch saves nothing.
class UndecidedTiles
{
public:
  /// Finds them.
  /// @param visibilityAndClass an image of pixels, x: visibility, y: class (classes.glsl)
  /// @param size of the image in pixels
  void find(GLuint visibilityAndClass, const glm::ivec2& size, ShaderLibrary& shaders);

  /// The program of a fragment shader in the tiles, made the one in use. With the definition MIXED
  /// it leaves out tiles near which all that faces the light has the same visibility.
  static GLuint use(ShaderLibrary& shaders, const std::string& fragmentGlsl,
    const std::vector<std::string>& defines);
  /// What it needs beside the fragment shader's.
  /// @param reachTiles how many tiles around an undecided one are drawn, too, along x and y
  std::vector<Uniform> uniforms(const glm::ivec2& reachTiles) const;
  /// Draws it.
  void fill(const std::vector<ScreenPass::Image>& images);

  /// How many tiles hold all that is as many pixels away.
  static int tilesOf(int pixels);

  std::size_t bytes() const;

private:
  GlTexture contents_; ///< undecided_tiles.frag.glsl
  ScreenPass screenPass_;
  glm::ivec2 size_{ 0 };  ///< of the picture
  glm::ivec2 tiles_{ 0 }; ///< along x and y
};

} // namespace gnomon
