#pragma once

#include "plugin/scene/PropMemory.h"

#include "lights/vtkGnomonVersions.h"

#include <cstddef>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Hashes a renderer's scene: its props, in the camera's view or not, its lights and its
/// background.
class ShownScene
{
public:
  /// Return the scene's hash. The same number means the same scene.
  std::size_t hash(vtkRenderer* renderer);

private:
  PropMemory propMemory_;
};

} // namespace gnomon
