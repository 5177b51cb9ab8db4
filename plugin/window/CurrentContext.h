#pragma once

// Excludes Xlib's headers, and their macros, from <EGL/egl.h>.
#ifndef EGL_NO_X11
#define EGL_NO_X11
#endif
#include <EGL/egl.h>

namespace gnomon
{

/// Remembers this thread's current context, of EGL or GLX, or that it has none, and restores that
/// on destruction. A thread has one or the other: while it has one of EGL, GLX ends the process.
class CurrentContext
{
public:
  static bool isOfGlx();
  /// Leave this thread without a context of GLX, beside which EGL has none.
  static void releaseGlx();

  CurrentContext();
  ~CurrentContext();
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

private:
  EGLDisplay display_;
  EGLSurface draw_;
  EGLSurface read_;
  EGLContext context_;
  ///@{
  /// GLX's; null and 0 if it has none of that.
  int (*glxMakeCurrent_)(void*, unsigned long, unsigned long, void*) = nullptr;
  void* glxDisplay_ = nullptr;
  unsigned long glxDraw_ = 0;
  unsigned long glxRead_ = 0;
  void* glxContext_ = nullptr;
  ///@}
};

} // namespace gnomon
