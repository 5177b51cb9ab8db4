#pragma once

#include "shadowtech/base/RunningSum.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace gnomon
{

/// The images that a picture was drawn into: colours and depths, with one or several samples per
/// pixel.
struct DrawnPicture
{
  TextureBinding colours;
  TextureBinding depths;
  int samples = 1; ///< several: both are GL_TEXTURE_2D_MULTISAMPLE
};

/// The mean of pictures that are added one after another: colours, with their alpha.
///
/// A pixel of several samples counts as VTK's windows show it. Colours count as light to the power
/// of 1 / gamma, and the mean is that of the light. The memory is that of two pictures, however
/// many are added.
class PictureMean
{
public:
  /// Start a new mean.
  /// @param gamma 1: colours are proportional to light
  /// @throws TextureMemoryError
  void begin(const glm::ivec2& size, double gamma);

  /// Add the next picture.
  void add(const DrawnPicture& picture);

  /// Replace colours and depths in a part of the bound framebuffer by the mean of the added
  /// pictures.
  /// @param depths the picture whose depths are shown, of each pixel the first sample's
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
