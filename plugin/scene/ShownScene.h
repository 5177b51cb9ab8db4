#pragma once

#include "plugin/scene/PropMemory.h"

#include <cstddef>

class vtkRenderer;

namespace gnomon
{

/// Tells whether a renderer's scene is as it was: its props, in the camera's view or not, its
/// lights and its background.
class ShownScene
{
public:
  /// The same number means the same scene.
  std::size_t hash(vtkRenderer* renderer);

private:
  PropMemory propMemory_;
};

} // namespace gnomon
