#pragma once

#include "shadowtech/base/Gl.h"

#include <cstddef>
#include <stdexcept>

namespace gnomon
{

/// A texture, or a buffer that shaders read, that is too large for OpenGL or for the machine. The
/// message says how much was asked for, and for maps which size would fit.
class TextureMemoryError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The kind of a texture: of 32-bit floats unless it says otherwise.
struct TexelFormat
{
  GLenum internalFormat; ///< GL_R32F, GL_DEPTH_COMPONENT32F, ...
  GLenum format;         ///< GL_RED, GL_DEPTH_COMPONENT, ...
  int channels;
  GLenum type = GL_FLOAT; ///< of a channel: GL_FLOAT, GL_UNSIGNED_INT, GL_UNSIGNED_BYTE
};

/// No texture may take a larger share of the memory that the machine has available when it is made:
/// drivers that draw by software promise more than there is, and the system then ends the program.
constexpr double largestTextureShare = 0.5;

/// Gives a texture its memory, and nearest filtering; its target is bound afterwards.
/// @param layers 0 for a GL_TEXTURE_2D, else those of a GL_TEXTURE_2D_ARRAY
/// @param what names it in the error
/// @param levels of a mip map, of arrays only; each half of the one before
/// @throws TextureMemoryError; the texture is then without memory
void allocateTexture(GlTexture& texture, const TexelFormat& format, int width, int height,
  int layers, const char* what, int levels = 1);

/// The same for a light's map. The error offers the largest power of two that fits as its side.
void allocateMap(
  GlTexture& texture, const TexelFormat& format, int sizeTexels, int layers, int levels = 1);

/// The same question for a light's map that is kept on the CPU, before its layers are made.
/// @throws TextureMemoryError, which offers the largest power of two that fits as its side
void requireRoomForMap(std::size_t bytesOfTexel, int sizeTexels, int layers);

/// The same question for a picture of colours and depths with samples of each pixel, which VTK
/// makes.
/// @param samples 0 where a pixel is not split
/// @throws TextureMemoryError
void requireRoomForPicture(int width, int height, int samples);

/// The most samples of a texel that OpenGL draws maps of moments with.
int mostMapSamples();

/// Gives a renderbuffer the memory of a map's layer with several samples of each texel.
/// @throws TextureMemoryError; the renderbuffer is then without memory
void allocateSamples(
  GlRenderbuffer& samples, const TexelFormat& format, int sizeTexels, int samplesPerTexel);

/// Whether shaders can read so much from one buffer, and the machine has as much.
/// @param what names it in the error
/// @throws TextureMemoryError
void requireRoomForStorage(std::size_t bytes, const char* what);

/// Gives a buffer that shaders read its memory and contents; it is bound to
/// GL_SHADER_STORAGE_BUFFER afterwards.
/// @param bytes > 0
/// @param data null: left open
/// @throws TextureMemoryError; the buffer is then without memory
void allocateStorage(GlBuffer& buffer, std::size_t bytes, const void* data, const char* what);

/// The same for a buffer that the CPU, too, sees all the time (OpenGL 4.4), until it goes.
/// @param access GL_MAP_READ_BIT, GL_MAP_WRITE_BIT
/// @return where it sees it
/// @throws TextureMemoryError; the buffer is then without memory
void* allocateMappedStorage(
  GlBuffer& buffer, std::size_t bytes, GLbitfield access, const char* what);

} // namespace gnomon
