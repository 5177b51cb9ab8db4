#pragma once

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <array>
#include <cstddef>
#include <vector>

namespace gnomon
{

/// An image of 32-bit floats that accumulates draws: each draw reads the sum so far
/// (running_sum.glsl) and writes the new one. The caller holds a GlStateGuard.
class RunningSum
{
public:
  /// @param channels 1 or 4
  explicit RunningSum(int channels = 1)
    : channels_(channels)
  {
  }

  /// Restart the sum at 0.
  /// @param what names the image in the error
  /// @throws TextureMemoryError
  void begin(int width, int height, const char* what)
  {
    this->isEmpty_ = true;
    const TexelFormat format = this->channels_ == 1 ? TexelFormat{ GL_R32F, GL_RED, 1 }
                                                    : TexelFormat{ GL_RGBA32F, GL_RGBA, 4 };
    glActiveTexture(GL_TEXTURE0);
    for (SizedTexture& image : this->images_)
    {
      image.allocate(format, width, height, 0, what);
    }
  }

  /// Free the memory.
  void clear()
  {
    this->images_ = {};
    this->isEmpty_ = true;
  }

  /// Return the uniforms of running_sum.glsl, which reads the sum so far.
  std::vector<Uniform> before() const
  {
    return { { "sumBefore", TextureBinding{ GL_TEXTURE_2D, this->texture() } },
      { "sumIsEmpty", this->isEmpty_ ? 1 : 0 } };
  }

  /// Draw the new sum by the program in use.
  void fill()
  {
    this->newest_ = 1 - this->newest_;
    const SizedTexture& image = this->images_[this->newest_];
    this->screenPass_.fill({ { image.name() } }, image.width(), image.height());
    this->isEmpty_ = false;
  }

  /// Return the sum's texture, after the first fill().
  GLuint texture() const { return this->images_[this->newest_].name(); }
  std::size_t bytes() const { return bytesOfAll(this->images_, &SizedTexture::bytes); }

  int channels() const { return this->channels_; }

private:
  int channels_;
  std::array<SizedTexture, 2> images_; ///< the newest sum and the next one's target
  std::size_t newest_ = 0;
  bool isEmpty_ = true;
  ScreenPass screenPass_;
};

} // namespace gnomon
