#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <string>

namespace gnomon::tool
{

/// Read a PNG or JPEG image.
/// @throws BadInput with a message that names the file
vtkSmartPointer<vtkImageData> readImage(const std::string& path);

/// Read a PNG or JPEG image as a texture with VTK's settings: repeated, nearest texel.
/// @throws BadInput with a message that names the file
vtkSmartPointer<vtkTexture> readTexture(const std::string& path);

} // namespace gnomon::tool
