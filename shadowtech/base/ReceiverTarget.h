#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon
{

/// The framebuffer of the receivers stage: images in 32-bit float, and a depth buffer. The triangle
/// of each pixel is always written; point and normal only if an estimator reads them on the GPU.
class ReceiverTarget
{
public:
  /// Bind the framebuffer for drawing, with the given size, and clear it. The caller has opened the
  /// viewport, the scissor box and the write masks. The fragment shader's outputs go
  /// - 0: nowhere;
  /// - 1: to fragments(), xy as in ReceiverImages, and with points zw: the normal's x and y;
  /// - 2: with points to points(), xyz: the position, w: the normal's z. Both are in view
  ///   coordinates; the normal is geometric, unit, on the camera's side.
  /// @throws TextureMemoryError before anything is bound
  void begin(int width, int height, bool withPoints);

  /// Bind the framebuffer again after a prop that may have bound another one.
  void bind();

  /// Restore the framebuffers that were bound at begin().
  /// @param blending true if blending is on outside
  void end(bool blending);

  /// Upload receivers instead of drawing them: one texel per pixel, bottom row first, with the
  /// channels that begin() lists.
  void fill(int width, int height, const std::vector<glm::vec4>& fragments,
    const std::vector<glm::vec4>& points);

  void read(ReceiverImages& images) const;
  /// Read the window depths back, one per pixel.
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
  SizedTexture fragments_;
  SizedTexture points_;
  SizedTexture depth_;
  GLint outerDrawFramebuffer_ = 0;
  GLint outerReadFramebuffer_ = 0;
  int width_ = 0;
  int height_ = 0;
  bool withPoints_ = false;
};

} // namespace gnomon
