#pragma once

#include "lights/CameraView.h"
#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <cstddef>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderState;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The picture that a render state asks for, in pixels: the renderer's part of the window, or the
/// whole framebuffer that an outer pass hands in.
glm::ivec2 sizeOf(const vtkRenderState* s);

/// Where that is in the framebuffer that is bound.
glm::ivec2 originOf(const vtkRenderState* s);

///@{
/// A renderer's camera, with places relative to a point before anything becomes float.
/// @param centreWorld the origin of centred coordinates
glm::dmat4 centredFromView(vtkRenderer* renderer, const glm::dvec3& centreWorld); ///< rigid
CameraView cameraOf(vtkRenderer* renderer, const glm::dvec3& centreWorld);
///@}

/// Adds a camera, and the size of its picture, to a hash.
void hashView(std::size_t& seed, const CameraView& camera, const glm::ivec2& size);

/// Whether a pass, which is asked in every frame, draws several views: one eye or tile at a time,
/// or several renderers.
class ViewCount
{
public:
  bool areSeveral(vtkRenderer* renderer);

private:
  /// Which the frame before was drawn for; only compared.
  const vtkRenderer* before_ = nullptr;
};

} // namespace gnomon
