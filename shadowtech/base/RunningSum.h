#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"

#include <array>
#include <cstddef>
#include <vector>

namespace gnomon
{

/// An image of 32-bit floats that several draws add to: each reads the sum of those before
/// (running_sum.glsl) and writes the new one. A GlStateGuard is the caller's business.
class RunningSum
{
public:
  /// @param channels 1 or 4
  explicit RunningSum(int channels = 1)
    : channels_(channels)
  {
  }

  /// Starts at 0.
  /// @param what names it in the error
  /// @throws TextureMemoryError
  void begin(int width, int height, const char* what);

  /// Gives the memory back.
  void clear();

  /// The uniforms of running_sum.glsl.
  std::vector<Uniform> before() const;

  /// Fills the image with the output of the program in use, which has added to the sum before.
  void fill();

  /// The sum, once anything was added.
  GLuint texture() const { return this->images_[this->newest_].name(); }
  std::size_t bytes() const;
  int channels() const { return this->channels_; }

private:
  int channels_;
  std::array<GlTexture, 2> images_; ///< the newest sum, and what the next one will be drawn into
  std::size_t newest_ = 0;
  bool isEmpty_ = true;
  ScreenPass screenPass_;
  int width_ = 0;
  int height_ = 0;
};

} // namespace gnomon
