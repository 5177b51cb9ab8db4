#pragma once

#include "lights/vtkGnomonVersions.h"

#include <vtkType.h>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Has a renderer draw into the lower left part of its viewport, for as long as this lives.
class ReducedPicture
{
public:
  /// @param factor by which its sides are divided; 1 leaves it as it is
  ReducedPicture(vtkRenderer* renderer, int factor);
  ~ReducedPicture();
  ReducedPicture(const ReducedPicture&) = delete;
  ReducedPicture& operator=(const ReducedPicture&) = delete;

private:
  vtkRenderer* renderer_;
  double before_[4];
};

/// Switches a renderer's UseShadows off for as long as this lives: vtkOpenGLRenderer's
/// UpdateGeometry would draw the props with vtkShadowMapPass, within our own frame.
class WithoutVtkShadows
{
public:
  explicit WithoutVtkShadows(vtkRenderer* renderer);
  ~WithoutVtkShadows() { this->useShadows_ = this->before_; }
  WithoutVtkShadows(const WithoutVtkShadows&) = delete;
  WithoutVtkShadows& operator=(const WithoutVtkShadows&) = delete;

private:
  vtkTypeBool& useShadows_;
  vtkTypeBool before_;
};

} // namespace gnomon
