#ifndef gnomon_shadowtech_base_ReceiverTarget_h
#define gnomon_shadowtech_base_ReceiverTarget_h

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Receivers.h"

#include <cstddef>

namespace gnomon
{

/// The framebuffer that the receivers stage draws into: a position and a normal image in 32-bit
/// float (ReceiverImages), and a depth buffer of its own.
class ReceiverTarget
{
public:
  /// Binds the framebuffer for drawing, with the given size and cleared. The fragment shader's
  /// output 1 goes to the position image, output 2 to the normal image, output 0 nowhere. The
  /// caller has opened the viewport, the scissor box and the write masks.
  void begin(int width, int height);

  /// Binds what was bound before.
  /// @param blending whether blending is switched on outside
  void end(bool blending);

  /// Reads both images back.
  void read(ReceiverImages& images) const;

  GLuint positions() const { return this->positions_.name(); }
  GLuint normals() const { return this->normals_.name(); }
  int width() const { return this->width_; }
  int height() const { return this->height_; }
  std::size_t bytes() const;

private:
  GlFramebuffer framebuffer_;
  GlTexture positions_;
  GlTexture normals_;
  GlTexture depth_;
  GLint outerDrawFramebuffer_ = 0;
  GLint outerReadFramebuffer_ = 0;
  int width_ = 0;
  int height_ = 0;
};

} // namespace gnomon

#endif
