#pragma once

#include "lights/vtkGnomonVersions.h"

#include <cstddef>

VTK_ABI_NAMESPACE_BEGIN
class vtkProp;
class vtkRenderer;
class vtkTexture;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// A hash of all that a prop's picture depends on, beside the camera and the lights.
struct PropStamp
{
  std::size_t hash = 0; ///< the same number means the same picture
  /// The class of a prop or mapper of unknown kind: VTK's redraw time may miss its changes. Null if
  /// there is none.
  const char* unknown = nullptr;
};

/// Return a prop's keys of vtkGnomonPropKeys, as bits.
int keysOf(vtkProp* prop);

/// Stamp a prop by the times and values of all that VTK draws it from, down to the data. Updates
/// the pipelines first, as VTK does when it draws.
PropStamp stampOf(vtkProp* prop, vtkRenderer* renderer);

/// Add a texture with its pixels to a hash.
/// @param texture may be null
void hashTexture(std::size_t& seed, vtkTexture* texture);

} // namespace gnomon
