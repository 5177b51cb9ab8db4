#include "plugin/scene/ShownView.h"

#include "lights/Hash.h"
#include "plugin/scene/DrawnProps.h"

#include <vtkCamera.h>
#include <vtkFrameBufferObjectBase.h>
#include <vtkRenderState.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

#include <glm/gtc/matrix_transform.hpp>

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

/// Return the rigid matrix of a camera's view space.
/// @param vtkView, projection VTK's matrices
glm::dmat4 viewFromWorld(const glm::dmat4& vtkView, const glm::dmat4& projection)
{
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

glm::ivec2 sizeOf(const vtkRenderState* s, int reductionFactor)
{
  glm::ivec2 size(0);
  if (auto* framebuffer = s->GetFrameBuffer())
  {
    framebuffer->GetLastSize(size.x, size.y);
    size /= reductionFactor;
  }
  else
  {
    int left = 0;
    int bottom = 0;
    s->GetRenderer()->GetTiledSizeAndOrigin(&size.x, &size.y, &left, &bottom);
  }
  return glm::max(size, 1);
}

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

ShownView shownView(vtkRenderer* renderer, const SceneFrame& frame)
{
  vtkCamera* const vtk = renderer->GetActiveCamera();
  const glm::dmat4 vtkView = toGlm(vtk->GetModelViewTransformMatrix());
  const glm::dmat4 projection =
    toGlm(vtk->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  const glm::dmat4 view = viewFromWorld(vtkView, projection);
  const glm::dmat4 units = glm::scale(glm::dmat4(1.0), glm::dvec3(frame.unitsPerWorld()));
  ShownView shown;
  // The view space counts in units, too. Only its origin has a length.
  shown.centredFromView = glm::inverse(view);
  shown.centredFromView[3] = glm::dvec4(frame.fromWorld(glm::dvec3(shown.centredFromView[3])), 1.0);
  shown.viewFromVtkView = view == vtkView ? units : units * view * glm::inverse(vtkView);
  shown.camera.viewFromCentred = glm::inverse(shown.centredFromView);
  glm::dmat4& clip = shown.camera.clipFromView = projection;
  if (shown.viewFromVtkView != glm::dmat4(1.0))
  {
    clip = clip * glm::inverse(shown.viewFromVtkView);
    if (shown.camera.eyeView().w == 0.0)
    {
      clip[0].w = clip[1].w = clip[2].w = 0.0; // without rounding's rest
    }
  }
  return shown;
}

void hashView(std::size_t& seed, const CameraView& camera, const glm::ivec2& size)
{
  hashMatrix(seed, camera.viewFromCentred);
  hashMatrix(seed, camera.clipFromView);
  hashCombine(seed, size.x);
  hashCombine(seed, size.y);
}

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
