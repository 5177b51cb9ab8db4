#pragma once

#include "shadowtech/base/Gl.h"

#include <cstddef>
#include <stdexcept>

namespace gnomon
{

/// A texture, or a buffer that shaders read, is too large for OpenGL or for the machine. The
/// message states its size, and for maps the largest size that fits.
class TextureMemoryError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The format of a texture's texels, by default of 32-bit floats.
struct TexelFormat
{
  GLenum internalFormat; ///< GL_R32F, GL_DEPTH_COMPONENT32F, ...
  GLenum format;         ///< GL_RED, GL_DEPTH_COMPONENT, ...
  int channels;
  GLenum type = GL_FLOAT; ///< of a channel: GL_FLOAT, GL_UNSIGNED_INT, GL_UNSIGNED_BYTE
};

struct TextureShape
{
  TexelFormat format{};
  int width = 0, height = 0;
  int layers = 0; ///< 0: no array
  int levels = 1;

  double bytes() const;
};

/// The largest share of the available memory that one texture may take when it is made. Software
/// OpenGL promises more memory than the machine has, and the system then ends the program.
constexpr double largestTextureShare = 0.5;

/// Allocate a texture with nearest filtering; its target is bound afterwards.
/// @param layers 0 for a GL_TEXTURE_2D, else those of a GL_TEXTURE_2D_ARRAY
/// @param what names the texture in the error
/// @param levels of a mip map, for arrays only; each level has half the side of the one before
/// @throws TextureMemoryError; the texture is then without memory
void allocateTexture(GlTexture& texture, const TexelFormat& format, int width, int height,
  int layers, const char* what, int levels = 1);

/// Allocate a light's map of sizeTexels x sizeTexels, otherwise like allocateTexture(). The error
/// states the largest power of two that fits as its side.
void allocateMap(
  GlTexture& texture, const TexelFormat& format, int sizeTexels, int layers, int levels = 1);

/// A texture that is allocated again only if its shape changes.
class SizedTexture : public GlTexture
{
public:
  /// Give it a shape, by allocateTexture(). A texture of that shape keeps its texels.
  /// @return true if it was allocated, and is bound
  bool allocate(
    const TexelFormat& format, int width, int height, int layers, const char* what, int levels = 1);
  /// The same for a light's map, by allocateMap().
  bool allocateMap(const TexelFormat& format, int sizeTexels, int layers, int levels = 1);

  const TexelFormat& format() const { return this->shape_.format; }
  int width() const { return this->shape_.width; }
  int height() const { return this->shape_.height; }
  int layers() const { return this->shape_.layers; }
  int levels() const { return this->shape_.levels; }
  /// Return the bytes of its texels; 0 if it has none.
  std::size_t bytes() const;

private:
  bool has(const TextureShape& shape);

  TextureShape shape_;
};

/// Check that there is memory for a light's map on the CPU, before its layers are made.
/// @throws TextureMemoryError with the largest power of two that fits as the map's side
void requireRoomForMap(std::size_t bytesOfTexel, int sizeTexels, int layers);

/// Check that there is memory for a picture of colours and depths that VTK is going to make.
/// @param samples per pixel; 0 or 1 for one sample
/// @throws TextureMemoryError
void requireRoomForPicture(int width, int height, int samples);

/// Return the most samples per texel that OpenGL supports for maps of moments.
int mostMapSamples();

/// Allocate a renderbuffer for one layer of a map with several samples per texel.
/// @throws TextureMemoryError; the renderbuffer is then without memory
void allocateSamples(
  GlRenderbuffer& samples, const TexelFormat& format, int sizeTexels, int samplesPerTexel);

} // namespace gnomon
