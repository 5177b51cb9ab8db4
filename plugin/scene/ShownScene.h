#pragma once

#include "plugin/scene/PlainProps.h"
#include "plugin/scene/TextureCutouts.h"

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
  TextureCutouts cutouts_;
  PlainProps plainProps_;
};

} // namespace gnomon
