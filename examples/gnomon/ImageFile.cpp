#include "ImageFile.h"

#include "Errors.h"
#include "Files.h"
#include "ReadGuarded.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include <png.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>

namespace gnomon::tool
{
namespace
{

/// Refuse unreasonable sizes, so a damaged header cannot make the program allocate all memory.
void requireReasonableSize(
  const std::string& path, std::int64_t width, std::int64_t height, std::int64_t channelCount)
{
  constexpr std::int64_t largestSide = 65536;
  constexpr std::int64_t mostValues = std::int64_t(1) << 29;
  if (width > largestSide || height > largestSide || width * height * channelCount > mostValues)
  {
    throw BadInput(path + ": is unreasonably large: " + std::to_string(width) + " x " +
      std::to_string(height) + " pixels with " + std::to_string(channelCount) + " channels");
  }
}

const char* suffixOf(LightChannel channel)
{
  return channel == LightChannel::Red ? ".R"
    : channel == LightChannel::Green  ? ".G"
    : channel == LightChannel::Blue   ? ".B"
                                      : "";
}

/// Read a picture by libpng, because vtkPNGReader ends the whole program on a truncated file.
Picture readPng(const std::string& path)
{
  requireReadableFile(path);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> freed(&image, png_image_free);
  const auto refuse = [&path, &image]
  { throw BadInput(path + ": is not a readable PNG file: " + image.message); };
  if (!png_image_begin_read_from_file(&image, path.c_str()))
  {
    refuse();
  }
  if (image.format & PNG_FORMAT_FLAG_LINEAR)
  {
    throw BadInput(path + ": has 16 bits per channel, expected 8");
  }
  requireReasonableSize(path, image.width, image.height, 4);
  image.format = PNG_FORMAT_RGBA;
  std::vector<unsigned char> rgba(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, rgba.data(), 0, nullptr))
  {
    refuse();
  }
  Picture picture;
  picture.width = static_cast<int>(image.width);
  picture.height = static_cast<int>(image.height);
  picture.rgb.reserve(3 * picture.pixelCount());
  for (std::size_t i = 0; i < picture.pixelCount(); ++i)
  {
    const unsigned char* const pixel = &rgba[4 * i];
    if (pixel[3] != 255)
    {
      throw BadInput(path + ": is transparent at pixel (" + std::to_string(i % image.width) + ", " +
        std::to_string(i / image.width) + "), expected an opaque picture");
    }
    picture.rgb.insert(picture.rgb.end(), pixel, pixel + 3);
  }
  return picture;
}

/// Write planes of floats as 32-bit channels, with row 0 on top as in memory. OpenEXR writes into
/// memory, because its files are closed without a check for a full disk.
void writeExr(const std::string& path, int width, int height, Imf::Header& header,
  const std::map<std::string, const std::vector<float>*>& planes)
{
  const std::size_t pixelCount = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Imf::FrameBuffer frame;
  for (const auto& [name, plane] : planes)
  {
    if (plane->size() != pixelCount)
    {
      throw std::invalid_argument("channel " + name + " does not have one value per pixel");
    }
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // OpenEXR's interface is not const, but it only reads from here.
    auto* const base = reinterpret_cast<char*>(const_cast<float*>(plane->data()));
    frame.insert(name,
      Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * static_cast<std::size_t>(width)));
  }
  Imf::StdOSStream bytes;
  try
  {
    Imf::OutputFile file(bytes, header);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  }
  catch (const std::exception& error)
  {
    throw Failure(path + ": writing failed: " + error.what());
  }
  writeWholeFile(path, bytes.str());
}

} // namespace

Picture capture(vtkRenderWindow* window)
{
  const int* const size = window->GetSize();
  Picture picture;
  picture.width = size[0];
  picture.height = size[1];
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, picture.width - 1, picture.height - 1, /*front=*/0, pixels);
  picture.rgb.resize(3 * picture.pixelCount());
  if (static_cast<std::size_t>(pixels->GetNumberOfValues()) != picture.rgb.size())
  {
    throw Failure("the window's picture cannot be read");
  }
  const std::size_t rowBytes = 3 * static_cast<std::size_t>(picture.width);
  for (int y = 0; y < picture.height; ++y)
  {
    std::memcpy(picture.rgb.data() + static_cast<std::size_t>(y) * rowBytes,
      pixels->GetPointer(0) + static_cast<std::size_t>(picture.height - 1 - y) * rowBytes,
      rowBytes);
  }
  return picture;
}

std::vector<unsigned char> encodePng(const Picture& picture)
{
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<unsigned char> bytes(size);
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr))
  {
    throw Failure("a picture of " + std::to_string(picture.width) + " x " +
      std::to_string(picture.height) + " pixels cannot be encoded as PNG: " + image.message);
  }
  bytes.resize(size);
  return bytes;
}

Picture classPicture(const VisibilityImages& images, std::optional<int> sceneIndex)
{
  for (std::size_t light = 0; light < images.classes.size(); ++light)
  {
    const ClassImage& image = images.classes[light];
    if (!image.classes.empty() &&
      images.sceneIndices[light] == sceneIndex.value_or(images.sceneIndices[light]))
    {
      Picture picture{ images.width, images.height, {} };
      for (const std::uint8_t pixelClass : image.ofPixels)
      {
        const auto& colour = image.classes.at(pixelClass).colour;
        picture.rgb.insert(picture.rgb.end(), colour.begin(), colour.end());
      }
      return picture;
    }
  }
  return {};
}

void writePicture(const Picture& picture, const std::string& path)
{
  requireWritableFile(path, "picture", { ".png", ".exr" });
  if (lowerExtension(path) == ".png")
  {
    const std::vector<unsigned char> bytes = encodePng(picture);
    writeWholeFile(path, std::string(bytes.begin(), bytes.end()));
  }
  else
  {
    const ChannelImage image = channelsOf(picture, 255.0f);
    Imf::Header header(picture.width, picture.height);
    std::map<std::string, const std::vector<float>*> planes;
    for (const auto& [name, plane] : image.channels)
    {
      planes[name] = &plane;
    }
    writeExr(path, picture.width, picture.height, header, planes);
  }
}

Picture readPicture(const std::string& path)
{
  const std::string extension = lowerExtension(path);
  if (extension == ".png")
  {
    return readPng(path);
  }
  if (extension != ".exr")
  {
    throw BadInput(
      path + ": the file type is \"" + extension + "\", expected a name that ends in .png or .exr");
  }
  const ChannelImage image = readChannels(path);
  Picture picture;
  picture.width = image.width;
  picture.height = image.height;
  picture.rgb.resize(3 * picture.pixelCount());
  static constexpr const char* names[] = { "R", "G", "B" };
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    const auto found = image.channels.find(names[channel]);
    if (found == image.channels.end())
    {
      throw BadInput(path + ": has no channel " + names[channel] + ", expected R, G and B");
    }
    for (std::size_t i = 0; i < found->second.size(); ++i)
    {
      const float value = found->second[i];
      // NaN becomes black.
      picture.rgb[3 * i + channel] =
        static_cast<unsigned char>(value > 0.0f ? std::lround(255.0f * std::min(value, 1.0f)) : 0);
    }
  }
  return picture;
}

ChannelImage readChannels(const std::string& path)
{
  requireReadableFile(path);
  try
  {
    Imf::InputFile file(path.c_str());
    if (!file.isComplete())
    {
      throw BadInput(path + ": is incomplete: rows are missing");
    }
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    std::int64_t channelCount = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    {
      ++channelCount;
      if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      {
        throw BadInput(
          path + ": channel " + channel.name() + " is subsampled, expected one value per pixel");
      }
    }
    requireReasonableSize(path, width, height, channelCount);

    ChannelImage image;
    image.width = static_cast<int>(width);
    image.height = static_cast<int>(height);
    Imf::FrameBuffer frame;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    {
      std::vector<float>& plane = image.channels[channel.name()];
      plane.resize(static_cast<std::size_t>(width * height));
      frame.insert(channel.name(),
        Imf::Slice::Make(Imf::FLOAT, plane.data(), window, sizeof(float),
          sizeof(float) * static_cast<std::size_t>(width)));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);

    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
    {
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
      {
        image.header[attribute.name()] = text->value();
      }
    }
    if (const auto* origin = header.findTypedAttribute<Imf::V3dAttribute>("origin"))
    {
      image.origin = { { origin->value().x, origin->value().y, origin->value().z } };
    }
    return image;
  }
  catch (const BadInput&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw BadInput(path + ": is not a readable EXR file: " + error.what());
  }
}

ChannelImage channelsOf(const Picture& picture, float unit)
{
  ChannelImage image;
  image.width = picture.width;
  image.height = picture.height;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
  {
    image.channels[std::array{ "R", "G", "B" }[i % 3]].push_back(
      static_cast<float>(picture.rgb[i]) / unit);
  }
  return image;
}

void writeVisibility(const VisibilityImages& images, const std::string& path,
  const std::map<std::string, std::string>& attributes)
{
  requireWritableFile(path, "visibility", { ".exr" });
  std::map<std::string, const std::vector<float>*> planes = {
    { "position.X", &images.positionX },
    { "position.Y", &images.positionY },
    { "position.Z", &images.positionZ },
    { "normal.X", &images.normalX },
    { "normal.Y", &images.normalY },
    { "normal.Z", &images.normalZ },
    { "coverage", &images.coverage },
  };
  for (std::size_t k = 0; k < images.visibility.size(); ++k)
  {
    planes["visibility." + std::to_string(images.sceneIndices.at(k)) +
      suffixOf(images.channels.at(k))] = &images.visibility[k];
  }
  Imf::Header header(images.width, images.height);
  for (const auto& [name, text] : attributes)
  {
    header.insert(name, Imf::StringAttribute(text));
  }
  header.insert(
    "origin", Imf::V3dAttribute(Imath::V3d(images.origin[0], images.origin[1], images.origin[2])));
  writeExr(path, images.width, images.height, header, planes);
}

vtkSmartPointer<vtkImageData> readImage(const std::string& path)
{
  vtkSmartPointer<vtkImageReader2> reader;
  readGuarded(path, requireReadableFile(path),
    [&]
    {
      reader = vtkSmartPointer<vtkPNGReader>::New();
      if (!reader->CanReadFile(path.c_str()))
      {
        reader = vtkSmartPointer<vtkJPEGReader>::New();
      }
      if (!reader->CanReadFile(path.c_str()))
      {
        throw BadInput("not a PNG or JPEG image");
      }
      reader->SetFileName(path.c_str());
      reader->Update();
    });
  return reader->GetOutput();
}

vtkSmartPointer<vtkTexture> readTexture(const std::string& path)
{
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(readImage(path));
  return texture;
}

} // namespace gnomon::tool
