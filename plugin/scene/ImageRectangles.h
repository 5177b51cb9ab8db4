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

/// What a vtkImageSlice shows its image on.
struct ImageRectangle
{
  vtkActor* actor = nullptr;    ///< whom VTK hands to a render pass; null: it is not served
  vtkPolyData* drawn = nullptr; ///< what that actor draws; VTK writes it again in every frame
  vtkPolyData* data = nullptr;  ///< the same cells, which change only when the rectangle does
};

/// Finds the rectangles of image slices, and keeps them while they are asked for.
class ImageRectangles
{
public:
  /// Begins a frame: what was not asked for since the last call is forgotten.
  void beginFrame();

  /// Brings the slice's mapper up to date first, as VTK does when it draws. Slices by
  /// vtkImageSliceMapper are served; large images, which VTK draws in pieces, by one rectangle.
  ImageRectangle find(vtkImageSlice* slice);

  std::size_t bytes() const;

private:
  /// The pointer to the slice names, it is not followed.
  struct Known
  {
    vtkSmartPointer<vtkPolyData> data;
    bool asked = false;
  };
  std::unordered_map<const vtkImageSlice*, Known> known_;
};

} // namespace gnomon
