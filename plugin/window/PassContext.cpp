#include "plugin/window/PassContext.h"

#include "shadowtech/base/Gl.h"

#include <vtkRenderPass.h>
#include <vtkRenderer.h>

namespace gnomon
{

std::string PassContext::enter(
  vtkRenderPass* pass, vtkRenderer* renderer, std::pair<int, int> least)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
  {
    return "The renderer has no OpenGL render window.";
  }
  window->MakeCurrent();
  if (window != this->window_ || window->GetContextCreationTime() > this->checked_.GetMTime())
  {
    pass->ReleaseGraphicsResources(this->window_);
    window->MakeCurrent(); // windows of toolkits do not restore the context that was
    this->window_ = window;
    this->checked_.Modified();
    std::pair<int, int> version;
    window->GetOpenGLVersion(version.first, version.second);
    const auto text = [](const std::pair<int, int>& number)
    { return std::to_string(number.first) + "." + std::to_string(number.second); };
    this->whyNot_ = version >= least ? ""
                                     : "Shadows need OpenGL " + text(least) +
        ", and this context has " + text(version) + ". The scene is drawn without shadows.";
  }
  return this->whyNot_;
}

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
