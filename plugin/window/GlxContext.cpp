#include "plugin/window/GlxContext.h"

#include <dlfcn.h>

#include <mutex>
#include <optional>
#include <type_traits>

namespace gnomon
{
namespace
{

/// The functions of GLX.
struct Glx
{
  void* (*getCurrentContext)();
  void* (*getCurrentDisplay)();
  unsigned long (*getCurrentDrawable)();
  unsigned long (*getCurrentReadDrawable)();
  int (*makeContextCurrent)(void* display, unsigned long draw, unsigned long read, void* context);

  /// Return nothing if GLX is not loaded. Else it stays loaded: to look it up and let it go takes
  /// half a millisecond, in each frame.
  static std::optional<Glx> load()
  {
    void* library = nullptr;
    for (const char* name : { "libGLX.so.0", "libGL.so.1" })
    {
      library = library ? library : dlopen(name, RTLD_LAZY | RTLD_NOLOAD);
    }
    Glx glx{};
    const auto find = [library](auto& function, const char* name)
    {
      function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, name));
      return function != nullptr;
    };
    const bool hasAll = library && find(glx.getCurrentContext, "glXGetCurrentContext") &&
      find(glx.getCurrentDisplay, "glXGetCurrentDisplay") &&
      find(glx.getCurrentDrawable, "glXGetCurrentDrawable") &&
      find(glx.getCurrentReadDrawable, "glXGetCurrentReadDrawable") &&
      find(glx.makeContextCurrent, "glXMakeContextCurrent");
    return hasAll ? std::optional(glx) : std::nullopt;
  }

  /// Return null if GLX is not loaded, or this thread has no context of it.
  static const Glx* ofThread()
  {
    static std::mutex mutex;
    static std::optional<Glx> loaded; // maybe by a later window
    const std::lock_guard<std::mutex> lock(mutex);
    loaded = loaded ? loaded : load();
    return loaded && loaded->getCurrentContext() ? &*loaded : nullptr;
  }
};

} // namespace

bool GlxContext::isCurrent()
{
  return Glx::ofThread() != nullptr;
}

void GlxContext::release()
{
  if (const Glx* const glx = Glx::ofThread())
  {
    glx->makeContextCurrent(glx->getCurrentDisplay(), 0, 0, nullptr);
  }
}

GlxContext::GlxContext()
{
  if (const Glx* const glx = Glx::ofThread())
  {
    this->makeCurrent_ = glx->makeContextCurrent;
    this->display_ = glx->getCurrentDisplay();
    this->draw_ = glx->getCurrentDrawable();
    this->read_ = glx->getCurrentReadDrawable();
    this->context_ = glx->getCurrentContext();
  }
}

GlxContext::~GlxContext()
{
  if (this->makeCurrent_)
  {
    this->makeCurrent_(this->display_, this->draw_, this->read_, this->context_);
  }
}

} // namespace gnomon
