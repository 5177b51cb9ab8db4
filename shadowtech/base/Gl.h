#pragma once

// OpenGL as VTK loads it (GNOMON_HAS_GL tests for a version), and owners of GL names.
#include "lights/vtkGnomonVersions.h"

#include GNOMON_VTK_GL_HEADER

#include <utility>

namespace gnomon
{

/// While an object of this class is alive, handles drop their GL names instead of deleting them.
/// The names' context is gone, and in the current context the same names may belong to other
/// objects.
class GlContextLost
{
public:
  GlContextLost() { lost = true; }
  ~GlContextLost() { lost = false; }
  GlContextLost& operator=(GlContextLost&&) = delete; ///< nor copied

  inline static thread_local bool lost = false;
};

/// Owns one GL name. Its context must be current when the name is created and when it is deleted.
template <typename Kind>
class GlHandle
{
public:
  GlHandle() = default;
  ~GlHandle() { this->reset(); }
  GlHandle(GlHandle&& other) noexcept
    : name_(other.release())
  {
  }
  GlHandle& operator=(GlHandle&& other) noexcept
  {
    if (this != &other)
    {
      this->reset();
      this->name_ = other.release();
    }
    return *this;
  }
  GlHandle(const GlHandle&) = delete;
  GlHandle& operator=(const GlHandle&) = delete;

  /// Return the name, created on first use.
  GLuint create()
  {
    if (!this->name_)
    {
      this->name_ = Kind::create();
    }
    return this->name_;
  }
  GLuint name() const { return this->name_; }
  explicit operator bool() const { return this->name_ != 0; }
  void reset()
  {
    const GLuint name = this->release();
    if (name && !GlContextLost::lost)
    {
      Kind::destroy(name);
    }
  }
  GLuint release() { return std::exchange(this->name_, 0u); }

private:
  GLuint name_ = 0;
};

// clang-format off
namespace glkind
{
struct Texture     { static GLuint create() { GLuint n = 0; glGenTextures(1, &n); return n; }
                     static void destroy(GLuint n) { glDeleteTextures(1, &n); } };
struct Buffer      { static GLuint create() { GLuint n = 0; glGenBuffers(1, &n); return n; }
                     static void destroy(GLuint n) { glDeleteBuffers(1, &n); } };
struct Framebuffer { static GLuint create() { GLuint n = 0; glGenFramebuffers(1, &n); return n; }
                     static void destroy(GLuint n) { glDeleteFramebuffers(1, &n); } };
struct Renderbuffer{ static GLuint create() { GLuint n = 0; glGenRenderbuffers(1, &n); return n; }
                     static void destroy(GLuint n) { glDeleteRenderbuffers(1, &n); } };
struct VertexArray { static GLuint create() { GLuint n = 0; glGenVertexArrays(1, &n); return n; }
                     static void destroy(GLuint n) { glDeleteVertexArrays(1, &n); } };
struct Program     { static GLuint create() { return glCreateProgram(); }
                     static void destroy(GLuint n) { glDeleteProgram(n); } };
}
// clang-format on

using GlTexture = GlHandle<glkind::Texture>;
using GlBuffer = GlHandle<glkind::Buffer>;
using GlFramebuffer = GlHandle<glkind::Framebuffer>;
using GlRenderbuffer = GlHandle<glkind::Renderbuffer>;
using GlVertexArray = GlHandle<glkind::VertexArray>;
using GlProgram = GlHandle<glkind::Program>;

} // namespace gnomon
