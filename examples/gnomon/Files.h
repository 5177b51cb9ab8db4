#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Refuses paths that lead to no readable regular file with at least one byte. Returns its size.
/// @throws BadInput
std::size_t requireReadableFile(const std::string& path);

/// A file's bytes.
/// @throws BadInput when it cannot be read or is larger than `largestBytes`
std::string readWholeFile(const std::string& path, std::size_t largestBytes);

/// Refuses an output path that cannot be written, before any work is done for it. Leaves an
/// existing file as it is and creates none. `option` is the option that gave the path, `extensions`
/// are those that it may have (".png"), in lower case.
/// @throws BadInput
void requireWritableFile(
  const std::string& path, const std::string& option, const std::vector<std::string>& extensions);

/// Writes a file in place of what stood there.
/// @throws Failure
void writeText(const std::string& path, const std::string& text);

/// The extension of a path with its dot, in lower case.
std::string lowerExtension(const std::string& path);

} // namespace gnomon::tool
