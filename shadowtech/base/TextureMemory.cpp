#include "shadowtech/base/TextureMemory.h"

#include "shadowtech/base/System.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace gnomon
{
namespace
{

void define(const TextureShape& shape, GLenum target)
{
  const auto internalFormat = static_cast<GLint>(shape.format.internalFormat);
  if (shape.levels > 1)
  {
    glTexStorage3D(
      target, shape.levels, shape.format.internalFormat, shape.width, shape.height, shape.layers);
  }
  else if (shape.layers > 0)
  {
    glTexImage3D(target, 0, internalFormat, shape.width, shape.height, shape.layers, 0,
      shape.format.format, shape.format.type, nullptr);
  }
  else
  {
    glTexImage2D(target, 0, internalFormat, shape.width, shape.height, 0, shape.format.format,
      shape.format.type, nullptr);
  }
}

/// True if OpenGL and the machine report room, before anything is allocated.
bool fits(const TextureShape& shape)
{
  if (shape.bytes() > largestTextureShare * availableBytes())
  {
    return false;
  }
  const GLenum proxy = shape.layers > 0 ? GL_PROXY_TEXTURE_2D_ARRAY : GL_PROXY_TEXTURE_2D;
  define(shape, proxy);
  GLint width = 0; // stays 0 for an impossible texture
  glGetTexLevelParameteriv(proxy, 0, GL_TEXTURE_WIDTH, &width);
  return width == shape.width;
}

void clearErrors()
{
  // Bounded, because a lost context reports an error each time.
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i)
  {
  }
}

bool allocate(GlTexture& texture, const TextureShape& shape)
{
  texture.reset(); // frees its memory first
  clearErrors();
  const bool room = fits(shape);
  clearErrors(); // some drivers raise one for a proxy
  if (!room)
  {
    return false;
  }
  const GLenum target = shape.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  glBindTexture(target, texture.create());
  define(shape, target);
  if (glGetError() != GL_NO_ERROR)
  {
    texture.reset();
    return false;
  }
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return true;
}

std::string describe(const std::string& what, int width, int height, int layers, double bytes,
  const std::string& memory)
{
  return what + " of " + std::to_string(width) + " x " + std::to_string(height) +
    (layers > 1 ? " in " + std::to_string(layers) + " layers" : "") + " needs " +
    std::to_string(static_cast<long>(bytes / 1e6)) + " MB of " + memory +
    ", which is not available";
}

std::string describe(const TextureShape& shape, const std::string& what)
{
  return describe(what, shape.width, shape.height, shape.layers, shape.bytes(), "texture memory");
}

/// Return "; 8192 x 8192 fits": the largest smaller power of two for which there is room, or the
/// smallest map.
template <typename IsRoom>
std::string offerSmaller(int sizeTexels, const IsRoom& isRoom)
{
  constexpr int smallest = 16;
  int side = smallest;
  while (2 * side < sizeTexels)
  {
    side *= 2;
  }
  while (side > smallest && !isRoom(side))
  {
    side /= 2;
  }
  return "; " + std::to_string(side) + " x " + std::to_string(side) + " fits";
}

} // namespace

double TextureShape::bytes() const
{
  const double bytesOfChannel = this->format.type == GL_UNSIGNED_BYTE ? 1.0
    : this->format.type == GL_UNSIGNED_SHORT                          ? 2.0
                                                                      : 4.0;
  double texels = 0.0;
  for (int level = 0; level < this->levels; ++level)
  {
    texels += static_cast<double>(this->width >> level) * (this->height >> level);
  }
  return texels * bytesOfChannel * this->format.channels * (this->layers > 0 ? this->layers : 1);
}

void allocateTexture(GlTexture& texture, const TexelFormat& format, int width, int height,
  int layers, const char* what, int levels)
{
  const TextureShape shape{ format, width, height, layers, levels };
  if (!allocate(texture, shape))
  {
    throw TextureMemoryError(describe(shape, what));
  }
}

void allocateMap(
  GlTexture& texture, const TexelFormat& format, int sizeTexels, int layers, int levels)
{
  const TextureShape shape{ format, sizeTexels, sizeTexels, layers, levels };
  if (allocate(texture, shape))
  {
    return;
  }
  const std::string offer = offerSmaller(sizeTexels,
    [&](int side) {
      return fits({ format, side, side, layers });
    });
  clearErrors();
  throw TextureMemoryError(describe(shape, "a map") + offer);
}

/// Return true if the texture has this shape; else note the shape for its allocation.
bool SizedTexture::has(const TextureShape& shape)
{
  const TextureShape before = std::exchange(this->shape_, shape);
  return *this && before.format.internalFormat == shape.format.internalFormat &&
    before.width == shape.width && before.height == shape.height && before.layers == shape.layers &&
    before.levels == shape.levels;
}

bool SizedTexture::allocate(
  const TexelFormat& format, int width, int height, int layers, const char* what, int levels)
{
  if (this->has({ format, width, height, layers, levels }))
  {
    return false;
  }
  allocateTexture(*this, format, width, height, layers, what, levels);
  return true;
}

bool SizedTexture::allocateMap(const TexelFormat& format, int sizeTexels, int layers, int levels)
{
  if (this->has({ format, sizeTexels, sizeTexels, layers, levels }))
  {
    return false;
  }
  gnomon::allocateMap(*this, format, sizeTexels, layers, levels);
  return true;
}

std::size_t SizedTexture::bytes() const
{
  return *this ? static_cast<std::size_t>(this->shape_.bytes()) : 0;
}

void requireRoomForMap(std::size_t bytesOfTexel, int sizeTexels, int layers)
{
  const auto bytes = [&](int side)
  { return static_cast<double>(bytesOfTexel) * side * side * layers; };
  const auto isRoom = [&](int side)
  { return bytes(side) <= largestTextureShare * availableBytes(); };
  if (!isRoom(sizeTexels))
  {
    throw TextureMemoryError(
      describe("a map", sizeTexels, sizeTexels, layers, bytes(sizeTexels), "memory") +
      offerSmaller(sizeTexels, isRoom));
  }
}

void requireRoomForPicture(int width, int height, int samples)
{
  constexpr double floatsOfSample = 5.0; // red, green, blue, alpha and depth
  const double bytes = floatsOfSample * sizeof(float) * width * height * std::max(samples, 1);
  if (bytes > largestTextureShare * availableBytes())
  {
    const std::string split =
      samples > 1 ? " with " + std::to_string(samples) + " samples of a pixel" : "";
    throw TextureMemoryError(
      describe("a picture" + split, width, height, 0, bytes, "texture memory"));
  }
}

int mostMapSamples()
{
  GLint most = std::numeric_limits<GLint>::max();
  for (const GLenum format : { GL_RG32F, GL_RGBA32F, GL_DEPTH_COMPONENT32F })
  {
    GLint samples = 1; // unchanged if there is only one
    glGetInternalformativ(GL_RENDERBUFFER, format, GL_SAMPLES, 1, &samples); // largest first
    most = std::min(most, samples);
  }
  return std::max(most, 1);
}

void allocateSamples(
  GlRenderbuffer& samples, const TexelFormat& format, int sizeTexels, int samplesPerTexel)
{
  samples.reset(); // frees its memory first
  const double bytes = static_cast<double>(sizeof(float)) * format.channels * sizeTexels *
    sizeTexels * samplesPerTexel;
  clearErrors();
  bool room = bytes <= largestTextureShare * availableBytes();
  if (room)
  {
    glBindRenderbuffer(GL_RENDERBUFFER, samples.create());
    glRenderbufferStorageMultisample(
      GL_RENDERBUFFER, samplesPerTexel, format.internalFormat, sizeTexels, sizeTexels);
    room = glGetError() == GL_NO_ERROR;
  }
  if (!room)
  {
    samples.reset();
    throw TextureMemoryError("a map of " + std::to_string(sizeTexels) + " x " +
      std::to_string(sizeTexels) + " with " + std::to_string(samplesPerTexel) +
      " samples of a texel needs " + std::to_string(static_cast<long>(bytes / 1e6)) +
      " MB, which is not available");
  }
}

} // namespace gnomon
