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

glm::dmat4 vtkViewFromWorld(vtkRenderer* renderer)
{
  return toGlm(renderer->GetActiveCamera()->GetModelViewTransformMatrix());
}

glm::dmat4 clipFromVtkView(vtkRenderer* renderer)
{
  return toGlm(renderer->GetActiveCamera()->GetProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0));
}

/// True if a transformation keeps lengths, angles and handedness.
bool isRigid(const glm::dmat4& matrix)
{
  constexpr double noise = 1e-6;
  const glm::dmat3 turn(matrix);
  const glm::dmat3 left = glm::transpose(turn) * turn - glm::dmat3(1.0);
  return glm::length(left[0]) + glm::length(left[1]) + glm::length(left[2]) < noise &&
    glm::determinant(turn) > 0.0;
}

/// True if a projection's depth and distance depend on z alone.
bool isUpright(const glm::dmat4& clipFromView)
{
  const auto is0 = [&](int row)
  { return clipFromView[0][row] == 0.0 && clipFromView[1][row] == 0.0; };
  return is0(2) && is0(3);
}

/// Return the rigid matrix of the camera's view space.
glm::dmat4 viewFromWorld(vtkRenderer* renderer)
{
  const glm::dmat4 vtkView = vtkViewFromWorld(renderer);
  const glm::dmat4 projection = clipFromVtkView(renderer);
  if (isRigid(vtkView) && isUpright(projection))
  {
    return vtkView;
  }
  CameraView camera;
  camera.clipFromView = projection * vtkView; // with world coordinates as view coordinates
  const glm::dmat4 rows = glm::transpose(camera.clipFromView);
  const glm::dvec4 eye = camera.eyeView();
  // Distances are constant across this axis; with a parallel projection, depths are.
  const glm::dvec3 back = -glm::normalize(glm::dvec3(eye.w != 0.0 ? rows[3] : rows[2]));
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(rows[1]), back));
  const glm::dvec3 origin(eye.w != 0.0 ? eye / eye.w : glm::inverse(vtkView)[3]);
  const glm::dmat3 turn = glm::transpose(glm::dmat3(right, glm::cross(back, right), back));
  glm::dmat4 view(turn);
  view[3] = glm::dvec4(-(turn * origin), 1.0);
  return view;
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
  glm::dmat4 matrix = glm::inverse(viewFromWorld(renderer));
  matrix[3] -= glm::dvec4(centreWorld, 0.0);
  return matrix;
}

//------------------------------------------------------------------------------
CameraView cameraOf(vtkRenderer* renderer, const glm::dvec3& centreWorld)
{
  CameraView view;
  view.viewFromCentred = glm::inverse(centredFromView(renderer, centreWorld));
  view.clipFromView = clipFromVtkView(renderer);
  const glm::dmat4 turn = viewFromVtkView(renderer);
  if (turn != glm::dmat4(1.0))
  {
    view.clipFromView = view.clipFromView * glm::inverse(turn);
    if (view.eyeView().w == 0.0)
    {
      glm::dmat4& clip = view.clipFromView;
      clip[0].w = clip[1].w = clip[2].w = 0.0; // without rounding's rest
    }
  }
  return view;
}

//------------------------------------------------------------------------------
glm::dmat4 viewFromVtkView(vtkRenderer* renderer)
{
  const glm::dmat4 vtkView = vtkViewFromWorld(renderer);
  const glm::dmat4 view = viewFromWorld(renderer);
  return view == vtkView ? glm::dmat4(1.0) : view * glm::inverse(vtkView);
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
