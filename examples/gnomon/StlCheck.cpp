#include "ModelChecks.h"

#include "ByteReader.h"
#include "Files.h"

#include <cstdint>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
void checkStlFile(const std::string& path)
{
  const std::string bytes = readWholeFile(path, largestModelBytes);
  constexpr std::size_t headerBytes = 80;
  constexpr std::size_t triangleBytes = 50;
  std::uint32_t triangles = 0;
  if (bytes.size() >= headerBytes + sizeof(triangles))
  {
    ByteReader reader(path, bytes);
    reader.skip(headerBytes, "the header");
    triangles = reader.read<std::uint32_t>("the number of triangles");
    if (triangles > 0 && bytes.size() == reader.position() + triangles * triangleBytes)
    {
      return;
    }
  }
  // vtkSTLReader checks text files itself, but reads truncated binary files without an error.
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || bytes.compare(first, 5, "solid") != 0)
  {
    throw BadInput(path + ": found " + std::to_string(bytes.size()) +
      " bytes of a binary STL file whose header announces " + std::to_string(triangles) +
      " triangles, expected " +
      std::to_string(headerBytes + sizeof(triangles) + triangles * triangleBytes) +
      " bytes, or text that starts with \"solid\"; it is truncated, empty or of another type");
  }
}

} // namespace gnomon::tool
