#pragma once

#include <string>

namespace gnomon::tool
{

// VTK's readers trust their input: a truncated file or an index out of range makes several of them
// write outside their memory. These functions check a file first and refuse such input. They also
// refuse input that a reader would silently replace by zeros.

///@{
/// Check a whole file of this type.
/// @throws BadInput
void checkObjFile(const std::string& path);
void checkPlyFile(const std::string& path);
void checkStlFile(const std::string& path);
void checkVtpFile(const std::string& path);
void check3dsFile(const std::string& path);
///@}

/// The largest size of a model file.
inline constexpr std::size_t largestModelBytes = std::size_t{ 4 } << 30;

} // namespace gnomon::tool
