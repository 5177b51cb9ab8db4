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

/// Of each pixel of the framebuffer that is bound; 0 where a pixel is not split.
int samplesOfBoundFramebuffer();

/// Where a render pass draws a picture of 32-bit floats in place of the framebuffer that it is
/// given, with as many samples per pixel.
class PictureTarget
{
public:
  /// Lays itself out as the framebuffer that is bound is laid out.
  /// @throws TextureMemoryError
  void resize(vtkOpenGLRenderWindow* window, const glm::ivec2& size);

  /// Has a pass draw, in front of the colours that are in the framebuffer that is bound where the
  /// renderer keeps them. The state of OpenGL is afterwards as it was.
  /// @param origin of the picture in that framebuffer
  void draw(vtkRenderPass* pass, const vtkRenderState* s, const glm::ivec2& origin);

  /// What was drawn last.
  DrawnPicture picture() const;

private:
  vtkSmartPointer<vtkOpenGLFramebufferObject> framebuffer_;
  glm::ivec2 size_{ 0 };
  int samples_ = 0;
};

} // namespace gnomon
