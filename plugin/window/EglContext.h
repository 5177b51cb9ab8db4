#pragma once

// Keeps Xlib's headers, and their macros, out of <EGL/egl.h>.
#ifndef EGL_NO_X11
#define EGL_NO_X11
#endif
#include <EGL/egl.h>

#include <memory>
#include <string>

namespace gnomon
{

/// What a context is asked for.
struct EglRequest
{
  int majorVersion = 4;
  int minorVersion = 5;
  int deviceIndex = -1; ///< place in EGL's list of devices; below 0: the best that works
};

/// An OpenGL core context that draws into framebuffer objects only, and needs no display.
///
/// Without a device index the candidates are tried in this order: EGL devices that are hardware,
/// the surfaceless platform, software devices, the default display. On each of them the version
/// asked for comes first, then lower ones down to 3.2; a driver may give a higher one that is
/// compatible.
class EglContext
{
public:
  /// Makes the context and makes it current.
  /// @throws std::runtime_error whose text names every candidate and what was wrong with it
  explicit EglContext(const EglRequest& request);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// False when EGL refuses; lastError() then says why.
  bool makeCurrent() const;
  bool isCurrent() const;
  EGLDisplay display() const;
  EGLContext context() const;
  /// What the context lives on, for people: "EGL device 0", "EGL surfaceless platform", ...
  const std::string& platform() const { return this->platform_; }

  /// How many devices EGL lists; 0 where it cannot list them.
  static int numberOfDevices();
  /// The name of EGL's last error on this thread, e.g. "EGL_BAD_MATCH".
  static std::string lastError();

private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  std::string platform_;
};

/// What was current on this thread; makes it current again when it goes.
class EglCurrentContext
{
public:
  EglCurrentContext();
  ~EglCurrentContext();
  EglCurrentContext(const EglCurrentContext&) = delete;
  EglCurrentContext& operator=(const EglCurrentContext&) = delete;

private:
  EGLDisplay display_;
  EGLSurface draw_;
  EGLSurface read_;
  EGLContext context_;
};

} // namespace gnomon
