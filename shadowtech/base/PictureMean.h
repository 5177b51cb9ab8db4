#pragma once

#include "shadowtech/base/GlState.h"
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
  void begin(const glm::ivec2& size, double gamma)
  {
    const GlStateGuard guard;
    this->pictures_ = 0;
    this->sum_.begin(size.x, size.y, "the sum of pictures");
    this->size_ = size;
    this->gamma_ = gamma;
  }

  void add(const DrawnPicture& picture)
  {
    const GlStateGuard guard;
    std::vector<Uniform> uniforms = this->sum_.before();
    uniforms.push_back({ "picture", picture.colours });
    const int units = this->use("shadowtech/base/picture_sum.frag.glsl", picture, uniforms);
    this->sum_.fill();
    ++this->pictures_;
    unbind(picture, units);
  }

  /// Replace colours and depths in a part of the bound framebuffer by the mean of the added
  /// pictures.
  /// @param depths the picture whose depths are shown, of each pixel the first sample's
  void show(const DrawnPicture& depths, const glm::ivec2& origin)
  {
    const GlStateGuard guard;
    const int units = this->use("shadowtech/base/picture_mean.frag.glsl", depths,
      { { "sum", TextureBinding{ GL_TEXTURE_2D, this->sum_.texture() } },
        { "depths", depths.depths }, { "pictures", static_cast<float>(this->pictures_) },
        { "origin", origin } });
    this->screenPass_.fillBound(origin, this->size_);
    unbind(depths, units);
  }

  std::size_t pictures() const { return this->pictures_; }

private:
  /// Unbind textures with several samples, which GlStateGuard does not restore.
  static void unbind(const DrawnPicture& picture, int units)
  {
    for (int unit = 0; picture.samples > 1 && unit < units; ++unit)
    {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
    }
  }

  /// Use a shader that reads a picture.
  /// @return the number of its texture units
  int use(const std::string& glslPath, const DrawnPicture& picture, std::vector<Uniform> uniforms)
  {
    std::vector<std::string> defines{ "SAMPLES " + std::to_string(picture.samples) };
    if (this->gamma_ != 1.0)
    {
      defines.emplace_back("ENCODED");
      uniforms.push_back({ "gamma", static_cast<float>(this->gamma_) });
    }
    const GLuint program =
      ScreenPass::use(this->shaders_, ShaderLibrary::source(glslPath), defines);
    return ShaderLibrary::setUniforms(program, uniforms, 0, 0);
  }

  RunningSum sum_{ 4 };
  ScreenPass screenPass_;
  ShaderLibrary shaders_;
  glm::ivec2 size_{ 0 };
  double gamma_ = 1.0;
  std::size_t pictures_ = 0;
};

} // namespace gnomon
