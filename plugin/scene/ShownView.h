#pragma once

#include "lights/CameraView.h"
#include "lights/SceneFrame.h"
#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <cstddef>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderState;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Return the size of a render state's picture, in pixels: the renderer's part of the window, or
/// the framebuffer that an outer pass hands in.
/// @param reductionFactor by which the picture is smaller than that framebuffer
glm::ivec2 sizeOf(const vtkRenderState* s, int reductionFactor = 1);

/// Return the origin of that picture in the bound framebuffer, in pixels.
glm::ivec2 originOf(const vtkRenderState* s);

/// A renderer's camera.
///
/// Its view space is VTK's if that is rigid, if depth and distance do not change across the
/// picture, and if the frame has the world's unit. Else it is another one, in which that is so for
/// all usual projections (vtkCamera's model, user view and explicit matrices, off-axis screens).
struct ShownView
{
  CameraView camera;
  glm::dmat4 centredFromView{ 1.0 }; ///< rigid
  glm::dmat4 viewFromVtkView{ 1.0 }; ///< from the coordinates that VTK's vertex shaders compute
};
ShownView shownView(vtkRenderer* renderer, const SceneFrame& frame);

/// Add a camera and the size of its picture to a hash.
void hashView(std::size_t& seed, const CameraView& camera, const glm::ivec2& size);

/// Tells whether a pass draws several views: one eye or tile at a time, or several renderers. The
/// pass must ask in every frame.
class ViewCount
{
public:
  bool areSeveral(vtkRenderer* renderer);

private:
  /// renderer of the previous frame; only compared
  const vtkRenderer* before_ = nullptr;
};

} // namespace gnomon
