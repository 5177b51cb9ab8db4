#ifndef gnomon_shadowtech_base_Gl_h
#define gnomon_shadowtech_base_Gl_h

// OpenGL as VTK loads it (vtk_glew.h is GLEW, VTK's own or the system's), and owners of GL names.
#include <vtk_glew.h>

#include <utility>

namespace gnomon
{

/// Owns one GL name. Destroy it, or reset() it, while its context is current; when the context is
/// already gone, release() forgets the name instead.
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

  /// The name, created on first use.
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
    if (this->name_)
    {
      Kind::destroy(this->name_);
      this->name_ = 0;
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
struct VertexArray { static GLuint create() { GLuint n = 0; glGenVertexArrays(1, &n); return n; }
                     static void destroy(GLuint n) { glDeleteVertexArrays(1, &n); } };
struct Program     { static GLuint create() { return glCreateProgram(); }
                     static void destroy(GLuint n) { glDeleteProgram(n); } };
}
// clang-format on

using GlTexture = GlHandle<glkind::Texture>;
using GlBuffer = GlHandle<glkind::Buffer>;
using GlFramebuffer = GlHandle<glkind::Framebuffer>;
using GlVertexArray = GlHandle<glkind::VertexArray>;
using GlProgram = GlHandle<glkind::Program>;

} // namespace gnomon

#endif
