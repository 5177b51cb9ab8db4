#pragma once

#include "lights/vtkGnomonVersions.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkTimeStamp.h>
#include <vtkWeakPointer.h>

#include <functional>
#include <string>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderPass;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The OpenGL context that a render pass keeps objects in.
class PassContext
{
public:
  /// Makes a renderer's context current. Where it is another one than in the frame before, the pass
  /// releases what it holds in that one (vtkRenderPass::ReleaseGraphicsResources).
  ///
  /// @param least the version of OpenGL that the pass takes: major, minor
  /// @return why Gnomon cannot draw there, a sentence; empty if it can
  std::string enter(vtkRenderPass* pass, vtkRenderer* renderer, std::pair<int, int> least);

  vtkOpenGLRenderWindow* window() const { return this->window_; }

  /// Leaves the context for good.
  /// @param release gives objects back, in the window whose context is current; null: it is gone,
  /// and names only are forgotten
  void leave(const std::function<void(vtkOpenGLRenderWindow*)>& release);

private:
  vtkWeakPointer<vtkOpenGLRenderWindow> window_;
  vtkTimeStamp checked_;
  std::string whyNot_;
};

} // namespace gnomon
