#include "plugin/scene/ShownView.h"

#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/Hash.h"

#include <vtkCamera.h>
#include <vtkFrameBufferObjectBase.h>
#include <vtkRenderState.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

namespace gnomon
{
namespace
{

/// True if the same pass draws other renderers of the window.
bool sharesPass(vtkRenderer* renderer)
{
  vtkRendererCollection* const all = renderer->GetRenderWindow()->GetRenderers();
  vtkCollectionSimpleIterator it;
  all->InitTraversal(it);
  while (vtkRenderer* other = all->GetNextRenderer(it))
  {
    if (other != renderer && other->GetDraw() && renderer->GetPass() &&
      other->GetPass() == renderer->GetPass())
    {
      return true;
    }
  }
  return false;
}

} // namespace

//------------------------------------------------------------------------------
glm::ivec2 sizeOf(const vtkRenderState* s)
{
  glm::ivec2 size(0);
  if (auto* framebuffer = s->GetFrameBuffer())
  {
    framebuffer->GetLastSize(size.x, size.y);
  }
  else
  {
    int left = 0;
    int bottom = 0;
    s->GetRenderer()->GetTiledSizeAndOrigin(&size.x, &size.y, &left, &bottom);
  }
  return glm::max(size, 1);
}

//------------------------------------------------------------------------------
glm::ivec2 originOf(const vtkRenderState* s)
{
  glm::ivec2 size(0);
  glm::ivec2 origin(0);
  if (!s->GetFrameBuffer())
  {
    s->GetRenderer()->GetTiledSizeAndOrigin(&size.x, &size.y, &origin.x, &origin.y);
  }
  return origin;
}

//------------------------------------------------------------------------------
glm::dmat4 centredFromView(vtkRenderer* renderer, const glm::dvec3& centreWorld)
{
  glm::dmat4 matrix =
    glm::inverse(toGlm(renderer->GetActiveCamera()->GetModelViewTransformMatrix()));
  matrix[3] -= glm::dvec4(centreWorld, 0.0);
  return matrix;
}

//------------------------------------------------------------------------------
CameraView cameraOf(vtkRenderer* renderer, const glm::dvec3& centreWorld)
{
  CameraView view;
  view.viewFromCentred = glm::inverse(centredFromView(renderer, centreWorld));
  view.clipFromView = toGlm(renderer->GetActiveCamera()->GetProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0));
  return view;
}

//------------------------------------------------------------------------------
void hashView(std::size_t& seed, const CameraView& camera, const glm::ivec2& size)
{
  hashMatrix(seed, camera.viewFromCentred);
  hashMatrix(seed, camera.clipFromView);
  hashCombine(seed, size.x);
  hashCombine(seed, size.y);
}

//------------------------------------------------------------------------------
bool ViewCount::areSeveral(vtkRenderer* renderer)
{
  int tiles[2] = { 1, 1 };
  renderer->GetRenderWindow()->GetTileScale(tiles);
  const bool other = this->before_ && this->before_ != renderer;
  this->before_ = renderer;
  return other || sharesPass(renderer) || renderer->GetRenderWindow()->GetStereoRender() ||
    tiles[0] > 1 || tiles[1] > 1;
}

} // namespace gnomon
