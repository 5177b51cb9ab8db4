#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

class ReceiverTarget;

/// CastingLight::bit of a light that has layers.
inline constexpr int noBit = -1;

/// The visibility images of the image route, one 32-bit float layer per casting light, or three
/// (red, green, blue) where its texture is seen (channelsOf()). Hard shadows of several lights are
/// bits of one more image instead, so that shaders fetch them at once. Row 0 is the bottom row.
class VisibilityLayers
{
public:
  /// How many bits there can be: those of two numbers a texel, of which 32 bits take one.
  static constexpr int mostBits = 64;

  /// Whether there are `layers` images of this size, and one of bits if there are `bits`.
  bool have(int width, int height, int layers, int bits) const
  {
    return width == this->width_ && height == this->height_ && layers == this->layers_ &&
      bits == this->bits_;
  }

  /// Allocates them. A change of size or number clears them.
  void resize(int width, int height, int layers, int bits);

  /// Fills a layer by a pointwise technique's GLSL, called for the receivers of all pixels.
  /// @param classes where not null, each pixel's class (TechniqueInfo::classes), of a technique
  /// that tells
  void estimate(int layer, const PointwiseTechnique& technique, const ShadowLight& light,
    const ReceiverTarget& receivers, const ReceiverSpace& space, ShaderLibrary& shaders,
    std::vector<std::uint8_t>* classes = nullptr);

  /// Fills a layer with the output of the program in use, called for every pixel (ScreenPass). A
  /// GlStateGuard is the caller's business.
  void fill(int layer);

  /// Fills layers with what a screen technique has computed on the CPU.
  /// @param visibility of as many layers as it has values for, one after the other
  void upload(int firstLayer, const std::vector<float>& visibility);

  /// Fills a bit with what a screen technique has computed on the CPU: 1 or 0 everywhere.
  void fillBit(int bit, const std::vector<float>& visibility);
  /// Fills bits of lights that are dark as a whole: 0 where a pixel shows a receiver, else 1.
  /// @param receives by pixel: 1 or 0
  void darkenBits(const std::vector<int>& bits, const std::vector<std::uint8_t>& receives);
  /// To be called once all bits are filled.
  void uploadBits();

  ///@{
  /// Reads a layer or a bit back.
  void read(int layer, std::vector<float>& visibility) const;
  void readBit(int bit, std::vector<float>& visibility) const;
  ///@}

  GLuint texture() const { return this->texture_.name(); }
  GLuint textureOfBits() const { return this->textureOfBits_.name(); }
  std::size_t bytes() const;

private:
  GlTexture texture_;
  ScreenPass screenPass_;
  int width_ = 0;
  int height_ = 0;
  int layers_ = 0;
  int bits_ = 0;
  GlTexture textureOfBits_;
  std::size_t wordsOfPixel_ = 0; ///< numbers of 32 bits
  std::vector<std::uint32_t> bitsOfPixels_;
  bool bitsChanged_ = false; ///< since the upload
};

} // namespace gnomon
