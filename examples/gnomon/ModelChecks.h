#pragma once

#include <string>

namespace gnomon::tool
{

// VTK's readers trust what they read: a truncated file or an index out of range makes several of
// them write outside of their memory. These functions walk through a file first and refuse what
// would do that, and what a reader would replace by zeros without a word.

///@{
/// Checks a whole file of that type.
/// @throws BadInput
void checkObjFile(const std::string& path);
void checkPlyFile(const std::string& path);
void checkStlFile(const std::string& path);
void checkVtpFile(const std::string& path);
void check3dsFile(const std::string& path);
///@}

/// No model file is larger.
inline constexpr std::size_t largestModelBytes = std::size_t{ 4 } << 30;

} // namespace gnomon::tool
