#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Return a file's size. Refuse paths without a readable regular file of at least one byte.
/// @throws BadInput
std::size_t requireReadableFile(const std::string& path);

/// Return a file's bytes.
/// @throws BadInput if it cannot be read or is larger than `largestBytes`
std::string readWholeFile(const std::string& path, std::size_t largestBytes);

/// Refuse an output path that cannot be written, before any work is done. No file is created or
/// changed.
/// @param option command line option of the path
/// @param extensions valid extensions in lower case, for example ".png"
/// @throws BadInput
void requireWritableFile(
  const std::string& path, const std::string& option, const std::vector<std::string>& extensions);

/// Write a file beside its path and rename it: on a full disk, no file is left and an existing one
/// stays unchanged. Devices and pipes are written directly.
/// @throws Failure
void writeWholeFile(const std::string& path, const std::string& bytes);

/// Return a name as a part of a file's name: "nsm-1024-inline" for "nsm 1024 inline".
std::string fileStem(const std::string& name);

/// Return a path's extension with its dot, in lower case.
std::string lowerExtension(const std::string& path);

} // namespace gnomon::tool
