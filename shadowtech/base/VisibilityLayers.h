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

/// The visibility images of the image route: one 32-bit float layer per casting light, or three
/// (red, green, blue) if the technique sees the light's texture (channelsOf()). Hard shadows are
/// bits of one more image instead, which shaders fetch at once, and which is small to upload. Row 0
/// is the bottom row.
class VisibilityLayers
{
public:
  /// The most bits: two channels of 32 bits.
  static constexpr int mostBits = 64;

  /// True if there are `layers` layers of this size, and an image of `bits` bits.
  bool have(int width, int height, int layers, int bits) const
  {
    return width == this->width_ && height == this->height_ && layers == this->layers_ &&
      bits == this->bits_;
  }

  /// Allocate the images. A change of size or number clears them.
  void resize(int width, int height, int layers, int bits);

  /// Fill a layer by a pointwise technique's GLSL, called for the receivers of all pixels.
  /// @param classes if not null, set to each pixel's class (TechniqueInfo::classes); for techniques
  /// that classify their pixels
  void estimate(int layer, const PointwiseTechnique& technique, const ShadowLight& light,
    const ReceiverTarget& receivers, const ReceiverSpace& space, ShaderLibrary& shaders,
    std::vector<std::uint8_t>* classes = nullptr);

  /// Fill a layer with the output of the program in use, called for every pixel (ScreenPass). The
  /// caller holds a GlStateGuard.
  void fill(int layer);

  /// Upload visibility that a screen technique computed on the CPU.
  /// @param visibility one image per layer, one after the other
  void upload(int firstLayer, const std::vector<float>& visibility);

  /// Set a bit to visibility that a screen technique computed on the CPU: 1 or 0 everywhere.
  void fillBit(int bit, const std::vector<float>& visibility);
  /// Set the bits of lights that are dark everywhere: 0 where a pixel shows a receiver, else 1.
  void darkenBits(const std::vector<int>& bits, const std::vector<std::uint8_t>& receives);
  /// Set a bit to 1 at some pixels, and to 0 at all others.
  void markBit(int bit, const std::vector<std::uint32_t>& pixels);
  /// Upload the bits, after all of them are set.
  /// @return false if none changed
  bool uploadBits();

  ///@{
  /// Read a layer or a bit back.
  void read(int layer, std::vector<float>& visibility) const;
  void readBit(int bit, std::vector<float>& visibility) const;
  ///@}

  GLuint texture() const { return this->texture_.name(); }
  GLuint textureOfBits() const { return this->textureOfBits_.name(); }
  std::size_t bytes() const;

private:
  std::size_t pixels() const
  {
    return static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_);
  }

  GlTexture texture_;
  ScreenPass screenPass_;
  int width_ = 0;
  int height_ = 0;
  int layers_ = 0;
  int bits_ = 0;
  GlTexture textureOfBits_;
  std::size_t bytesOfPixel_ = 0; ///< of its bits: 0, 1, 2, 4 or 8
  std::vector<std::uint8_t> bitsOfPixels_;
  bool bitsChanged_ = false; ///< since the last upload
};

} // namespace gnomon
