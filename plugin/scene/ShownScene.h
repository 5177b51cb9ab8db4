#pragma once

#include "lights/vtkGnomonVersions.h"

#include <cstddef>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Return a hash of a renderer's scene: its props, in the camera's view or not, its lights and its
/// background. The same number means the same scene.
std::size_t hashOfShownScene(vtkRenderer* renderer);

} // namespace gnomon
