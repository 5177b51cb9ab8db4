#include "plugin/scene/ShadedView.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace gnomon
{

ShadedView::ShadedView(vtkRenderer* renderer)
  : renderer_(renderer)
{
  vtkCamera* const camera = renderer->GetActiveCamera();
  this->camera_ = camera;
  this->time_ = camera->GetMTime();
  const double* const elements = camera->GetModelViewTransformMatrix()->GetData();
  std::copy_n(elements, 16, this->viewFromWorld_.begin());
  this->angle_ = camera->GetViewAngle();
}

bool ShadedView::isShown(bool withAngle) const
{
  vtkCamera* const camera = this->renderer_->GetActiveCamera();
  if (camera == this->camera_ && camera->GetMTime() == this->time_)
  {
    return true;
  }
  const ShadedView now(this->renderer_);
  return now.viewFromWorld_ == this->viewFromWorld_ &&
    (!withAngle || std::abs(now.angle_ - this->angle_) < 1e-6 * this->angle_);
}

} // namespace gnomon
