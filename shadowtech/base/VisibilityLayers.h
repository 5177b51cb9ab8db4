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

/// The visibility images of the image route, one 32-bit float layer per casting light, or three
/// (red, green, blue) where its texture is seen (channelsOf()). Row 0 is the bottom row.
class VisibilityLayers
{
public:
  /// Whether there are `layers` images of this size.
  bool have(int width, int height, int layers) const
  {
    return width == this->width_ && height == this->height_ && layers == this->layers_;
  }

  /// Makes room for `layers` images of this size. What other ones show is lost.
  void resize(int width, int height, int layers);

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

  /// Reads a layer back.
  void read(int layer, std::vector<float>& visibility) const;

  GLuint texture() const { return this->texture_.name(); }
  std::size_t bytes() const;

private:
  GlTexture texture_;
  ScreenPass screenPass_;
  int width_ = 0;
  int height_ = 0;
  int layers_ = 0;
};

} // namespace gnomon
