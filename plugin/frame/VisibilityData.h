#pragma once

#include "lights/vtkGnomonVersions.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

struct VisibilityImages;

/// Copy a frame's visibility into an image whose point (x, y, 0) is the pixel (x, y), counted from
/// the bottom row. vtkGnomonShadowPass::GetVisibilityImage() lists the arrays of its point data.
void fillImage(const VisibilityImages& images, vtkImageData* image);

} // namespace gnomon
