#pragma once

#include "shadowtech/base/RunningSum.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace gnomon
{

/// What a picture was drawn into: images of colours and depths, with one sample per pixel or
/// several.
struct DrawnPicture
{
  TextureBinding colours;
  TextureBinding depths;
  int samples = 1; ///< several: both are GL_TEXTURE_2D_MULTISAMPLE
};

/// The mean of pictures that are added one after another: colours, with their alpha.
///
/// A picture's pixel is that of its samples which VTK's windows show. Its colours are taken for
/// what light there is to the power of 1 / gamma: the mean is that of the light. The memory is that
/// of two pictures, however many are added.
class PictureMean
{
public:
  /// Forgets what was added.
  /// @throws TextureMemoryError
  void begin(const glm::ivec2& size, double gamma);

  /// Adds the next picture.
  void add(const DrawnPicture& picture);

  /// Shows the mean of what was added in a part of the framebuffer that is bound, in place of its
  /// colours and depths.
  /// @param depths whose depths are shown, of each pixel the first sample's
  void show(const DrawnPicture& depths, const glm::ivec2& origin);

  std::size_t pictures() const { return this->pictures_; }

private:
  int use(const std::string& glslPath, const DrawnPicture& picture, std::vector<Uniform> uniforms);

  RunningSum sum_{ 4 };
  ScreenPass screenPass_;
  ShaderLibrary shaders_;
  glm::ivec2 size_{ 0 };
  double gamma_ = 1.0;
  std::size_t pictures_ = 0;
};

} // namespace gnomon
