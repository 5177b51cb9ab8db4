#pragma once

#include "lights/vtkGnomonVersions.h"

#include <vtkType.h>

#include <array>

VTK_ABI_NAMESPACE_BEGIN
class vtkCamera;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The view that a frame's shaders are made for. A pass inside may draw by another camera.
class ShadedView
{
public:
  /// @param renderer must outlive this
  explicit ShadedView(vtkRenderer* renderer);

  /// True if the renderer's camera now has this view.
  /// @param withAngle true if the angle must be the same, too, up to rounding: visibility of the
  /// picture's pixels needs that
  bool isShown(bool withAngle) const;

private:
  vtkRenderer* renderer_;
  const vtkCamera* camera_; ///< only to be compared
  vtkMTimeType time_;
  std::array<double, 16> viewFromWorld_;
  double angle_; ///< in degrees
};

} // namespace gnomon
