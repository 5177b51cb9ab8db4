#pragma once

#include "lights/vtkGnomonVersions.h"

#include "shadowtech/base/PictureMean.h"

#include <glm/glm.hpp>

#include <vtkOpenGLFramebufferObject.h>
#include <vtkSmartPointer.h>

VTK_ABI_NAMESPACE_BEGIN
class vtkOpenGLRenderWindow;
class vtkRenderPass;
class vtkRenderState;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Return the samples per pixel of the bound framebuffer; 0 if pixels are not split.
int samplesOfBoundFramebuffer();

/// Target in which a render pass draws a picture of 32-bit floats instead of its framebuffer, with
/// as many samples per pixel.
class PictureTarget
{
public:
  /// Resize to `size`, with the bound framebuffer's samples per pixel.
  /// @throws TextureMemoryError
  void resize(vtkOpenGLRenderWindow* window, const glm::ivec2& size);

  /// Make a pass draw into this target. If the renderer preserves colours, start from a copy of the
  /// bound framebuffer's. Restores OpenGL's state.
  /// @param origin of the picture in that framebuffer
  void draw(vtkRenderPass* pass, const vtkRenderState* s, const glm::ivec2& origin);

  /// Return the last drawn picture.
  DrawnPicture picture() const;

private:
  vtkSmartPointer<vtkOpenGLFramebufferObject> framebuffer_;
  glm::ivec2 size_{ 0 };
  int samples_ = 0;
};

} // namespace gnomon
