#pragma once

#include "lights/vtkGnomonVersions.h"

#include <vtkRenderState.h>

#include <exception>
#include <functional>
#include <memory>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkProp;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// While it lives, calls one function before a renderer draws a group of its opaque props, and
/// another after them. Two props that draw nothing enclose the group, so this works for any render
/// pass. The renderer's other props follow. Both groups keep their order.
class AroundOpaque
{
public:
  /// Each function is called once. It may throw; then the second one is not called.
  /// @param isAmong true for the props of the group
  AroundOpaque(const vtkRenderState* s, const std::function<bool(vtkProp*)>& isAmong,
    std::function<void()> before, std::function<void()> afterwards);
  ~AroundOpaque();
  AroundOpaque(const AroundOpaque&) = delete;
  AroundOpaque& operator=(const AroundOpaque&) = delete;

  /// Return the state to draw instead of the given one. The renderer itself draws the same.
  const vtkRenderState* state() const { return &this->state_; }

  /// End the drawing of the scene.
  /// @throws the error of one of the functions, or std::runtime_error if they were not called
  void end() const;

private:
  void call(std::size_t which);

  vtkRenderer* renderer_;
  vtkProp** propsBefore_;
  int countBefore_;
  std::function<void()> functions_[2];
  std::size_t called_ = 0; ///< number of functions called
  std::exception_ptr error_;
  std::vector<vtkProp*> own_;   ///< the enclosing props
  std::vector<vtkProp*> props_; ///< the renderer's and its own, in the order of drawing
  vtkRenderState state_;
};

} // namespace gnomon
