#include "plugin/window/PassContext.h"

#include "shadowtech/base/Gl.h"

#include <vtkRenderPass.h>
#include <vtkRenderer.h>

namespace gnomon
{

//------------------------------------------------------------------------------
bool PassContext::enter(vtkRenderPass* pass, vtkRenderer* renderer, std::pair<int, int> least)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
  {
    vtkErrorWithObjectMacro(pass, "The renderer has no OpenGL render window.");
    return false;
  }
  window->MakeCurrent();
  if (window != this->window_ || window->GetContextCreationTime() > this->checked_.GetMTime())
  {
    pass->ReleaseGraphicsResources(this->window_);
    this->window_ = window;
    this->checked_.Modified();
    std::pair<int, int> version;
    window->GetOpenGLVersion(version.first, version.second);
    this->serves_ = version >= least;
    if (!this->serves_)
    {
      vtkErrorWithObjectMacro(pass,
        "Shadows need OpenGL " << least.first << "." << least.second << ", and this context has "
                               << version.first << "." << version.second
                               << ". The scene is drawn without shadows.");
    }
  }
  return this->serves_;
}

//------------------------------------------------------------------------------
void PassContext::leave(const std::function<void(vtkOpenGLRenderWindow*)>& release)
{
  if (this->window_)
  {
    // Mappers may hold the last reference to a pass that they were drawn with, and drop it while
    // another window is being drawn.
    this->window_->PushContext();
    release(this->window_);
    this->window_->PopContext();
  }
  else
  {
    const GlContextLost contextLost;
    release(nullptr);
  }
  this->window_ = nullptr;
}

} // namespace gnomon
