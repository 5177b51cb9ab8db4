#include "plugin/window/RendererScopes.h"

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>

namespace gnomon
{
namespace
{

/// Naming the member through a subclass gives access to it. The renderer's own function would tell
/// all observers that the renderer was modified.
struct ShadowsAccess : vtkRenderer
{
  static vtkTypeBool& useShadows(vtkRenderer* renderer)
  {
    return renderer->*(&ShadowsAccess::UseShadows);
  }
};

} // namespace

ReducedPicture::ReducedPicture(vtkRenderer* renderer, int factor)
  : renderer_(renderer)
{
  renderer->GetViewport(this->before_);
  const int* const window = renderer->GetRenderWindow()->GetActualSize();
  if (factor == 1 || window[0] < 1 || window[1] < 1)
  {
    return;
  }
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  const double* const tile = renderer->GetRenderWindow()->GetTileViewport();
  double viewport[4];
  for (int axis = 0; axis < 2; ++axis)
  {
    const int last = origin[axis] + std::max(size[axis] / factor, 1);
    const double side = tile[axis + 2] - tile[axis];
    viewport[axis] = std::max(this->before_[axis], tile[axis]);
    viewport[axis + 2] = tile[axis] + side * last / window[axis];
  }
  renderer->SetViewport(viewport);
}

ReducedPicture::~ReducedPicture()
{
  this->renderer_->SetViewport(this->before_); // which tells observers of changes alone
}

WithoutVtkShadows::WithoutVtkShadows(vtkRenderer* renderer)
  : useShadows_(ShadowsAccess::useShadows(renderer))
  , before_(this->useShadows_)
{
  this->useShadows_ = 0;
}

} // namespace gnomon
