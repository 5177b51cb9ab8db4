#include "ImageCheck.h"

#include "VtkMessages.h"

#include "plugin/vtk_versions/ReadFromMemory.h"

#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <png.h>
#include <zlib.h>

#include <cstdint>
#include <vector>

namespace gnomon::tool
{

namespace
{

bool startsWith(const std::string& bytes, const std::string& start)
{
  return bytes.compare(0, start.size(), start) == 0;
}

/// True if a PNG file is a sequence of chunks with valid check sums that ends with IEND.
bool hasWholeChunks(const std::string& bytes)
{
  const auto bigEndian = [&](std::size_t position)
  {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      value = value << 8 | static_cast<unsigned char>(bytes[position + i]);
    }
    return value;
  };
  constexpr std::size_t signatureBytes = 8;
  constexpr std::size_t emptyChunkBytes = 12; // length, type, check sum
  std::size_t position = signatureBytes;
  while (position + emptyChunkBytes <= bytes.size())
  {
    const std::size_t length = bigEndian(position);
    if (length > bytes.size() - position - emptyChunkBytes)
    {
      return false;
    }
    const auto* type = reinterpret_cast<const unsigned char*>(bytes.data()) + position + 4;
    if (crc32(0, type, static_cast<uInt>(length + 4)) != bigEndian(position + 8 + length))
    {
      return false;
    }
    if (bytes.compare(position + 4, 4, "IEND") == 0)
    {
      return true;
    }
    position += emptyChunkBytes + length;
  }
  return false;
}

bool isWholePng(const std::string& bytes)
{
  if (!hasWholeChunks(bytes))
  {
    return false;
  }
  // libpng's simplified interface survives every kind of damage.
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()))
  {
    return false;
  }
  constexpr png_uint_32 largestSide = 16384;
  if (image.width > largestSide || image.height > largestSide)
  {
    png_image_free(&image);
    return false;
  }
  image.format = PNG_FORMAT_RGBA;
  std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(image));
  const bool good = png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0;
  png_image_free(&image);
  return good;
}

bool isWholeJpeg(const std::string& bytes)
{
  // libjpeg fills in missing data at the end.
  if (bytes.rfind("\xff\xd9") == std::string::npos)
  {
    return false;
  }
  VtkMessages messages;
  vtkNew<vtkJPEGReader> reader;
  readFromMemory(reader, bytes);
  return messages.errors().empty() && reader->GetOutput()->GetPointData()->GetScalars();
}

} // namespace

//------------------------------------------------------------------------------
std::string imageType(const std::string& bytes)
{
  return startsWith(bytes, "\x89PNG\r\n\x1a\n") ? "image/png"
    : startsWith(bytes, "\xff\xd8\xff")         ? "image/jpeg"
                                                : "";
}

//------------------------------------------------------------------------------
bool isWholeImage(const std::string& bytes)
{
  const std::string type = imageType(bytes);
  return type == "image/png" ? isWholePng(bytes) : type == "image/jpeg" && isWholeJpeg(bytes);
}

} // namespace gnomon::tool
