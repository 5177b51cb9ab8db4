#pragma once

#include <string>

namespace gnomon::tool
{

/// "image/png" or "image/jpeg", by an image file's first bytes; empty for anything else.
std::string imageType(const std::string& bytes);

/// Whether a PNG or JPEG file's bytes can be decoded to their end. vtkPNGReader crashes where they
/// cannot.
bool isWholeImage(const std::string& bytes);

} // namespace gnomon::tool
