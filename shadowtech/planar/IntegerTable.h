#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon
{

/// A long table of integers in a texture, which shaders read by table.glsl.
class IntegerTable
{
public:
  explicit IntegerTable(const TexelFormat& format)
    : format_(format)
  {
  }

  /// Replace the table. This changes OpenGL's state; the caller restores it (GlStateGuard).
  /// @param entries one per texel, of the format's size; padded to whole rows
  /// @param what names the table in errors
  template <typename Entry>
  void set(std::vector<Entry> entries, const char* what)
  {
    const std::size_t rows = std::max((entries.size() + columns - 1) / columns, std::size_t(1));
    entries.resize(rows * columns);
    this->bytes_ = entries.size() * sizeof(Entry);
    glActiveTexture(GL_TEXTURE0);
    if (static_cast<int>(rows) != this->rows_)
    {
      this->rows_ = 0; // stays 0 if memory runs out
      allocateTexture(this->texture_, this->format_, columns, static_cast<int>(rows), 0, what);
      this->rows_ = static_cast<int>(rows);
    }
    glBindTexture(GL_TEXTURE_2D, this->texture_.name());
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, this->rows_, this->format_.format,
      this->format_.type, entries.data());
  }

  GLuint texture() const { return this->texture_.name(); }
  std::size_t bytes() const { return this->bytes_; }

private:
  static constexpr int columns = 4096;

  TexelFormat format_;
  GlTexture texture_;
  int rows_ = 0;
  std::size_t bytes_ = 0;
};

} // namespace gnomon
