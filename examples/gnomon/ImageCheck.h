#pragma once

#include <string>

namespace gnomon::tool
{

/// Return "image/png" or "image/jpeg" by an image file's first bytes; empty for other files.
std::string imageType(const std::string& bytes);

/// True if a PNG or JPEG file's bytes can be decoded to their end. vtkPNGReader crashes on others.
bool isWholeImage(const std::string& bytes);

} // namespace gnomon::tool
