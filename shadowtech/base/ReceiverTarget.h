#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon
{

/// The framebuffer that the receivers stage draws into: images in 32-bit float, and a depth buffer
/// of its own. Which triangle a pixel shows is always written; the point and its normal only where
/// estimators will read them on the GPU.
class ReceiverTarget
{
public:
  /// Binds the framebuffer for drawing, with the given size and cleared. The caller has opened the
  /// viewport, the scissor box and the write masks. The fragment shader's outputs go
  /// - 0: nowhere;
  /// - 1: to fragments(), xy as in ReceiverImages, and with points zw: the normal's x and y;
  /// - 2: with points to points(), xyz: the position, w: the normal's z. Both in view coordinates,
  ///   the normal geometric, unit, on the camera's side.
  /// @throws TextureMemoryError before anything is bound
  void begin(int width, int height, bool withPoints);

  /// Binds what was bound before.
  /// @param blending whether blending is switched on outside
  void end(bool blending);

  /// Uploads receivers in place of drawing them: one texel a pixel, bottom row first, with the
  /// channels that begin() lists.
  void fill(int width, int height, const std::vector<glm::vec4>& fragments,
    const std::vector<glm::vec4>& points);

  /// Reads the fragments back.
  void read(ReceiverImages& images) const;
  /// Reads the window depths back, one a pixel.
  void readDepths(std::vector<float>& depths) const;

  GLuint fragments() const { return this->fragments_.name(); }
  GLuint points() const { return this->points_.name(); }
  GLuint depths() const { return this->depth_.name(); }
  int width() const { return this->width_; }
  int height() const { return this->height_; }
  std::size_t bytes() const;

private:
  void allocate(int width, int height, bool withPoints);

  GlFramebuffer framebuffer_;
  GlTexture fragments_;
  GlTexture points_;
  GlTexture depth_;
  GLint outerDrawFramebuffer_ = 0;
  GLint outerReadFramebuffer_ = 0;
  int width_ = 0;
  int height_ = 0;
  bool withPoints_ = false;
};

} // namespace gnomon
