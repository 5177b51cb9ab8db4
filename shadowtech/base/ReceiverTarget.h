#ifndef gnomon_shadowtech_base_ReceiverTarget_h
#define gnomon_shadowtech_base_ReceiverTarget_h

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Receivers.h"

#include <cstddef>

namespace gnomon
{

/// The framebuffer that the receivers stage draws into: images in 32-bit float, and a depth buffer of
/// its own.
class ReceiverTarget
{
public:
  /// Binds the framebuffer for drawing, with the given size and cleared. The caller has opened the
  /// viewport, the scissor box and the write masks. The fragment shader's outputs go
  /// - 0: nowhere;
  /// - 1: to positions(), xyz in view coordinates, w VTK's primitive number;
  /// - 2: to surfaces(), x the drawn surface (ReceiverImages::drawn), and yzw, where they are asked
  ///   for, the geometric normal in view coordinates, on the camera's side.
  /// @param withNormals whether a shader will read the normals; without them less is written
  void begin(int width, int height, bool withNormals);

  /// Binds what was bound before.
  /// @param blending whether blending is switched on outside
  void end(bool blending);

  /// Reads positions, primitive numbers and surfaces back.
  void read(ReceiverImages& images) const;

  GLuint positions() const { return this->positions_.name(); }
  GLuint surfaces() const { return this->surfaces_.name(); }
  int width() const { return this->width_; }
  int height() const { return this->height_; }
  std::size_t bytes() const;

private:
  GlFramebuffer framebuffer_;
  GlTexture positions_;
  GlTexture surfaces_;
  GlTexture depth_;
  GLint outerDrawFramebuffer_ = 0;
  GLint outerReadFramebuffer_ = 0;
  int width_ = 0;
  int height_ = 0;
  bool withNormals_ = false;
};

} // namespace gnomon

#endif
