#include "plugin/window/PictureTarget.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/TextureMemory.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkRenderPass.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <string>

namespace gnomon
{
namespace
{

/// Copy the colours of a framebuffer's part, sample by sample.
void copyColours(GLuint from, GLuint to, const glm::ivec2& origin, const glm::ivec2& size)
{
  const GlStateGuard guard;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(origin.x, origin.y, origin.x + size.x, origin.y + size.y, 0, 0, size.x, size.y,
    GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

TextureBinding bindingOf(vtkTextureObject* texture)
{
  return { texture->GetTarget(), texture->GetHandle() };
}

} // namespace

int samplesOfBoundFramebuffer()
{
  GLint samples = 0;
  glGetIntegerv(GL_SAMPLES, &samples);
  return samples;
}

void PictureTarget::resize(vtkOpenGLRenderWindow* window, const glm::ivec2& size)
{
  const int samples = samplesOfBoundFramebuffer();
  if (this->size_ == size && this->samples_ == samples)
  {
    return;
  }
  this->size_ = glm::ivec2(0);  // stays 0 if memory runs out
  this->framebuffer_ = nullptr; // free the old memory first
  requireRoomForPicture(size.x, size.y, samples);
  vtkOpenGLState* state = window->GetState();
  GLint texture = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture);
  state->PushFramebufferBindings();
  this->framebuffer_ = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  this->framebuffer_->SetContext(window);
  const bool made =
    this->framebuffer_->PopulateFramebuffer(size.x, size.y, true, 1, VTK_FLOAT, true, 32, samples);
  state->PopFramebufferBindings();
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(texture));
  if (!made)
  {
    throw TextureMemoryError("OpenGL has no picture of " + std::to_string(size.x) + " x " +
      std::to_string(size.y) +
      " pixels of 32-bit floats; samples of a pixel: " + std::to_string(std::max(samples, 1)));
  }
  this->size_ = size;
  this->samples_ = samples;
}

void PictureTarget::draw(vtkRenderPass* pass, const vtkRenderState* s, const glm::ivec2& origin)
{
  vtkRenderer* renderer = s->GetRenderer();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  GLint given = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &given);

  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(state, GL_SCISSOR_TEST);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglEnableDisable blending(state, GL_BLEND);
  state->PushFramebufferBindings();
  this->framebuffer_->Bind();
  this->framebuffer_->ActivateDrawBuffer(0);
  if (renderer->Transparent())
  {
    copyColours(static_cast<GLuint>(given), this->framebuffer_->GetFBOIndex(), origin, this->size_);
  }
  state->vtkglViewport(0, 0, this->size_.x, this->size_.y);
  state->vtkglScissor(0, 0, this->size_.x, this->size_.y);
  state->vtkglEnable(GL_DEPTH_TEST);
  vtkRenderState inPicture(renderer);
  inPicture.SetPropArrayAndCount(s->GetPropArray(), s->GetPropArrayCount());
  inPicture.SetFrameBuffer(this->framebuffer_);
  pass->Render(&inPicture);
  state->PopFramebufferBindings();
}

DrawnPicture PictureTarget::picture() const
{
  return { bindingOf(this->framebuffer_->GetColorAttachmentAsTextureObject(0)),
    bindingOf(this->framebuffer_->GetDepthAttachmentAsTextureObject()),
    std::max(this->samples_, 1) };
}

} // namespace gnomon
