#include "plugin/window/CurrentContext.h"

#include <dlfcn.h>

#include <optional>
#include <type_traits>

namespace gnomon
{
namespace
{

/// The functions of GLX, of a thread that has a context of it.
struct Glx
{
  void* (*getCurrentContext)();
  void* (*getCurrentDisplay)();
  unsigned long (*getCurrentDrawable)();
  unsigned long (*getCurrentReadDrawable)();
  int (*makeContextCurrent)(void* display, unsigned long draw, unsigned long read, void* context);

  /// Return nothing if GLX is not loaded, or this thread has no context of it.
  static std::optional<Glx> ofThread()
  {
    void* library = nullptr;
    for (const char* name : { "libGLX.so.0", "libGL.so.1" })
    {
      library = library ? library : dlopen(name, RTLD_LAZY | RTLD_NOLOAD);
    }
    if (!library)
    {
      return std::nullopt;
    }
    Glx glx{};
    const auto load = [library](auto& function, const char* name)
    {
      function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, name));
      return function != nullptr;
    };
    const bool hasAll = load(glx.getCurrentContext, "glXGetCurrentContext") &&
      load(glx.getCurrentDisplay, "glXGetCurrentDisplay") &&
      load(glx.getCurrentDrawable, "glXGetCurrentDrawable") &&
      load(glx.getCurrentReadDrawable, "glXGetCurrentReadDrawable") &&
      load(glx.makeContextCurrent, "glXMakeContextCurrent");
    dlclose(library); // what has loaded it keeps it
    return hasAll && glx.getCurrentContext() ? std::optional(glx) : std::nullopt;
  }
};

} // namespace

//------------------------------------------------------------------------------
bool CurrentContext::isOfGlx()
{
  return Glx::ofThread().has_value();
}

//------------------------------------------------------------------------------
void CurrentContext::releaseGlx()
{
  if (const std::optional<Glx> glx = Glx::ofThread())
  {
    glx->makeContextCurrent(glx->getCurrentDisplay(), 0, 0, nullptr);
  }
}

//------------------------------------------------------------------------------
CurrentContext::CurrentContext()
  : display_(eglGetCurrentDisplay())
  , draw_(eglGetCurrentSurface(EGL_DRAW))
  , read_(eglGetCurrentSurface(EGL_READ))
  , context_(eglGetCurrentContext())
{
  if (const std::optional<Glx> glx = Glx::ofThread())
  {
    this->glxMakeCurrent_ = glx->makeContextCurrent;
    this->glxDisplay_ = glx->getCurrentDisplay();
    this->glxDraw_ = glx->getCurrentDrawable();
    this->glxRead_ = glx->getCurrentReadDrawable();
    this->glxContext_ = glx->getCurrentContext();
  }
}

//------------------------------------------------------------------------------
CurrentContext::~CurrentContext()
{
  const EGLContext current = eglGetCurrentContext();
  if (this->context_ != current)
  {
    eglMakeCurrent(this->context_ != EGL_NO_CONTEXT ? this->display_ : eglGetCurrentDisplay(),
      this->draw_, this->read_, this->context_);
  }
  if (this->glxMakeCurrent_)
  {
    this->glxMakeCurrent_(this->glxDisplay_, this->glxDraw_, this->glxRead_, this->glxContext_);
  }
}

} // namespace gnomon
