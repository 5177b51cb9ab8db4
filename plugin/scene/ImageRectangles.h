#pragma once

#include "lights/vtkGnomonVersions.h"

#include <vtkSmartPointer.h>

#include <cstddef>
#include <unordered_map>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkImageSlice;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The rectangle on which a vtkImageSlice shows its image.
struct ImageRectangle
{
  vtkActor* actor = nullptr;    ///< the actor that VTK hands to a render pass; null if not
                                ///< supported
  vtkPolyData* drawn = nullptr; ///< that actor's polydata, which VTK writes in every frame
  vtkPolyData* data = nullptr;  ///< the same cells, which change only when the rectangle does
};

/// Finds the rectangles of image slices, and caches them while they are in use.
class ImageRectangles
{
public:
  /// Begin a frame: drop rectangles that nothing asked for since the last call.
  void beginFrame();

  /// Return a slice's rectangle. Updates the slice's mapper first, as VTK does when it draws.
  /// Supports slices by vtkImageSliceMapper. A large image, which VTK draws in pieces, has one
  /// rectangle.
  ImageRectangle find(vtkImageSlice* slice);

  std::size_t bytes() const;

private:
  /// The pointer to the slice is only an identity and is never dereferenced.
  struct Known
  {
    vtkSmartPointer<vtkPolyData> data;
    bool asked = false;
  };
  std::unordered_map<const vtkImageSlice*, Known> known_;
};

} // namespace gnomon
