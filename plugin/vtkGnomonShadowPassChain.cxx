// The place of vtkGnomonShadowPass in a renderer's chain of passes.
#include "vtkGnomonLightSamplingPass.h"
#include "vtkGnomonShadowPassInternals.h"

#include "shadowtech/base/Gl.h"

#include "vtkCameraPass.h"
#include "vtkImageProcessingPass.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderWindow.h"
#include "vtkSSAAPass.h"
#include "vtkSequencePass.h"
#include "vtkShadowMapPass.h"

#include <algorithm>
#include <string>

namespace
{

/// Call a function with a pass as the first of some classes that it belongs to, if there is one.
template <typename... Classes, typename Call>
void callAs(vtkRenderPass* pass, const Call& call)
{
  const auto callIf = [&](auto* of) { return of && (call(of), true); };
  static_cast<void>((callIf(Classes::SafeDownCast(pass)) || ...));
}

/// Call a function with a pass that has a delegate.
template <typename Call>
void withDelegate(vtkRenderPass* pass, const Call& call)
{
  callAs<vtkImageProcessingPass, vtkSSAAPass, vtkCameraPass, vtkGnomonLightSamplingPass,
    vtkGnomonShadowPass>(pass, call);
}

vtkRenderPass* delegateOf(vtkRenderPass* pass)
{
  vtkRenderPass* delegate = nullptr;
  withDelegate(pass, [&](auto* of) { delegate = of->GetDelegatePass(); });
  return delegate;
}

/// True if a pass works on the finished picture, or has it drawn several times, so that shadows are
/// within it. vtkSSAOPass draws, although it is a vtkImageProcessingPass.
bool standsAround(vtkRenderPass* pass)
{
  return (pass->IsA("vtkImageProcessingPass") && !pass->IsA("vtkSSAOPass")) ||
    pass->IsA("vtkSSAAPass") || pass->IsA("vtkGnomonLightSamplingPass");
}

/// True if VTK's own shadow maps are drawn by a pass.
bool hasShadowMaps(vtkRenderPass* pass)
{
  if (auto* sequence = vtkSequencePass::SafeDownCast(pass); sequence && sequence->GetPasses())
  {
    vtkRenderPassCollection* const passes = sequence->GetPasses();
    for (int i = 0; i < passes->GetNumberOfItems(); ++i)
    {
      if (hasShadowMaps(vtkRenderPass::SafeDownCast(passes->GetItemAsObject(i))))
      {
        return true;
      }
    }
  }
  return pass && (pass->IsA("vtkShadowMapPass") || hasShadowMaps(delegateOf(pass)));
}

std::string namesOf(vtkRenderPass* pass)
{
  vtkRenderPass* const delegate = delegateOf(pass);
  return pass->GetClassName() + (delegate ? " around " + namesOf(delegate) : "");
}

/// A place in a chain: a pass's delegate, or the pass of the renderer itself.
struct Place
{
  vtkRenderer* renderer;
  vtkRenderPass* outer; ///< null: the renderer itself

  vtkRenderPass* pass() const
  {
    return this->outer ? delegateOf(this->outer) : this->renderer->GetPass();
  }
  void set(vtkRenderPass* pass) const
  {
    if (!this->outer)
    {
      this->renderer->SetPass(pass);
    }
    withDelegate(this->outer, [&](auto* of) { of->SetDelegatePass(pass); });
  }
};

/// True if an outer pass has the scene drawn into a framebuffer of its own. Not all of them say so
/// in the render state.
bool drawsIntoOuterPass(const vtkRenderState* s)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(s->GetRenderer()->GetRenderWindow());
  if (!window)
  {
    return false;
  }
  GLint framebuffer = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  return static_cast<GLuint>(framebuffer) != window->GetRenderFramebuffer()->GetFBOIndex();
}

} // namespace

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::Install(vtkRenderer* renderer)
{
  if (!renderer)
  {
    vtkErrorMacro("There is no renderer to install shadows in.");
    return;
  }
  this->Uninstall(renderer);
  Place place{ renderer, nullptr };
  vtkRenderPass* outer = nullptr;
  for (vtkRenderPass* pass = renderer->GetPass(); pass; pass = delegateOf(pass))
  {
    if (pass == this)
    {
      return; // a program has given it its place
    }
    if (pass->IsA("vtkGnomonShadowPass"))
    {
      place.outer = outer; // other shadows have the place
      break;
    }
    place.outer = standsAround(pass) ? pass : place.outer;
    outer = pass;
  }
  const vtkSmartPointer<vtkRenderPass> replaced = place.pass();
  vtkGnomonShadowPass* const others = SafeDownCast(replaced);
  vtkRenderPass* const inner = others ? others->GetDelegatePass() : replaced.Get();
  const bool takesInner = inner && !this->DelegatePass && !hasShadowMaps(inner);
  if (takesInner)
  {
    this->SetDelegatePass(inner);
  }
  else if (inner)
  {
    vtkWarningMacro("The renderer's pass gave way to shadows: " << namesOf(inner) << ".");
  }
  if (replaced && replaced != this->DelegatePass && renderer->GetRenderWindow())
  {
    replaced->ReleaseGraphicsResources(renderer->GetRenderWindow()); // it may never draw again
  }
  this->Internal->places.push_back({ renderer, replaced, takesInner });
  place.set(this);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::Uninstall(vtkRenderer* renderer)
{
  auto& places = this->Internal->places;
  const auto found = std::find_if(places.begin(), places.end(),
    [&](const Internals::TakenPlace& taken) { return renderer && taken.renderer == renderer; });
  if (found == places.end())
  {
    return;
  }
  const Internals::TakenPlace taken = *found;
  places.erase(found);
  if (taken.hasDelegate)
  {
    this->SetDelegatePass(nullptr);
  }
  Place place{ renderer, nullptr };
  while (place.pass() && place.pass() != this)
  {
    place.outer = place.pass();
  }
  if (place.pass())
  {
    place.set(taken.replaced);
  }
}

//------------------------------------------------------------------------------
vtkRenderPass* vtkGnomonShadowPass::FindDelegate(const vtkRenderState* s)
{
  if (s->GetRenderer()->GetSelector())
  {
    return nullptr;
  }
  if (!this->DelegatePass && drawsIntoOuterPass(s))
  {
    // The renderer's own drawing copies depths between framebuffers of its own formats.
    return this->Internal->steps;
  }
  return this->DelegatePass;
}
