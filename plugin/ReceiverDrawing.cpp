#include "plugin/ReceiverDrawing.h"

#include "plugin/Hash.h"
#include "plugin/ShownView.h"

#include <vtkActor2D.h>
#include <vtkInformation.h>
#include <vtkInformationObjectBaseVectorKey.h>
#include <vtkOpenGLRenderPass.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkProp.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkVolume.h>

namespace gnomon
{
namespace
{

/// Hides from a prop's shaders all render passes but one, for as long as it lives: other passes may
/// write outputs of their own.
class WithoutOtherPasses
{
public:
  WithoutOtherPasses(vtkProp* prop, vtkObjectBase* pass)
    : keys_(prop->GetPropertyKeys())
  {
    if (this->keys_ && this->keys_->Length(vtkOpenGLRenderPass::RenderPasses()) > 1)
    {
      this->hidden_ = vtkSmartPointer<vtkInformation>::New();
      this->hidden_->CopyEntry(this->keys_, vtkOpenGLRenderPass::RenderPasses());
      this->keys_->Remove(vtkOpenGLRenderPass::RenderPasses());
      this->keys_->Append(vtkOpenGLRenderPass::RenderPasses(), pass);
    }
  }
  ~WithoutOtherPasses()
  {
    if (this->hidden_)
    {
      this->keys_->CopyEntry(this->hidden_, vtkOpenGLRenderPass::RenderPasses());
    }
  }
  WithoutOtherPasses(const WithoutOtherPasses&) = delete;
  WithoutOtherPasses& operator=(const WithoutOtherPasses&) = delete;

private:
  vtkInformation* keys_;
  vtkSmartPointer<vtkInformation> hidden_;
};

} // namespace

//------------------------------------------------------------------------------
std::size_t hashOfReceivers(
  const vtkRenderState* s, const CameraView& camera, const glm::ivec2& size)
{
  std::size_t seed = 0;
  hashView(seed, camera, size);
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    vtkProp* prop = s->GetPropArray()[i];
    // Annotations and volumes receive nothing: a text that tells the frame's time is no other picture.
    if (!vtkActor2D::SafeDownCast(prop) && !vtkVolume::SafeDownCast(prop))
    {
      hashCombine(seed, prop);
      hashCombine(seed, prop->GetRedrawMTime());
    }
  }
  return seed;
}

//------------------------------------------------------------------------------
void drawReceivers(const vtkRenderState* s, vtkObjectBase* pass, const glm::ivec2& size,
  bool withPoints, ReceiverTarget& target)
{
  // VTK draws here and keeps its own record of the state, so the state is changed through that
  // record.
  vtkRenderer* renderer = s->GetRenderer();
  vtkOpenGLState* state =
    vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow())->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglColorMask colorMask(state);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  state->vtkglViewport(0, 0, size.x, size.y);
  state->vtkglScissor(0, 0, size.x, size.y);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglEnable(GL_DEPTH_TEST);

  target.begin(size.x, size.y, withPoints);
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    const WithoutOtherPasses alone(s->GetPropArray()[i], pass);
    s->GetPropArray()[i]->RenderOpaqueGeometry(renderer);
  }
  target.end(state->GetEnumState(GL_BLEND));
}

} // namespace gnomon
