#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Run a file's reader. VTK's readers trust their input, and checks before them cannot cover all
/// that they trust. Where a reader crashes or does not end, the program therefore prints one line
/// that names the file, and ends with exit code 2. Calls may be nested.
/// @param bytes size of the file and of its neighbours, which bounds the reader's time and memory
/// @return VTK's warnings
/// @throws BadInput if the reader throws, runs out of memory or makes VTK report an error; the
/// message begins with the file's name
std::vector<std::string> readGuarded(
  const std::string& path, std::size_t bytes, const std::function<void()>& read);

} // namespace gnomon::tool
