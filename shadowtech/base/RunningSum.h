#pragma once

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
  void begin(int width, int height, const char* what);

  /// Free the memory.
  void clear();

  /// Return the uniforms of running_sum.glsl, which reads the sum so far.
  std::vector<Uniform> before() const;

  /// Draw the new sum by the program in use.
  void fill();

  /// Return the sum's texture, after the first fill().
  GLuint texture() const { return this->images_[this->newest_].name(); }
  std::size_t bytes() const;
  int channels() const { return this->channels_; }

private:
  int channels_;
  std::array<SizedTexture, 2> images_; ///< the newest sum and the next one's target
  std::size_t newest_ = 0;
  bool isEmpty_ = true;
  ScreenPass screenPass_;
};

} // namespace gnomon
