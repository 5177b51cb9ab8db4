#pragma once

// Excludes Xlib's headers, and their macros, from <EGL/egl.h>.
#ifndef EGL_NO_X11
#define EGL_NO_X11
#endif
#include <EGL/egl.h>

#include <memory>
#include <string>

namespace gnomon
{

/// The end of errors in a forked process.
inline const std::string forkAdvice =
  ", and OpenGL does not follow: fork before, or start a new program (in Python: the start method "
  "'spawn' of multiprocessing)";

/// Requirements of a context.
struct EglRequest
{
  int majorVersion = 4;
  int minorVersion = 5;
  int deviceIndex = -1; ///< index in EGL's list of devices; below 0: the best that works
};

/// An OpenGL core context that draws into framebuffer objects only, and needs no display.
///
/// Without a device index it tries candidates in this order: EGL devices that are hardware, the
/// surfaceless platform, software devices, the default display. On each it tries the requested
/// version first, then lower ones down to 3.2. A driver may give a higher version that is
/// compatible.
class EglContext
{
public:
  /// Make the context and make it current.
  /// @throws std::runtime_error that names every candidate and why it failed
  explicit EglContext(const EglRequest& request);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Make the context current, in place of one of GLX, too. False if EGL refuses; lastError() then
  /// says why.
  bool makeCurrent() const;
  bool isCurrent() const;
  /// True if the process was not forked since.
  bool isOfThisProcess() const;
  EGLDisplay display() const;
  EGLContext context() const;
  /// Return the context's place for display: "EGL device 0", "EGL surfaceless platform", ...
  const std::string& platform() const { return this->platform_; }

  /// Return the number of devices that EGL lists; 0 if it cannot list them.
  static int numberOfDevices();
  /// Return the name of EGL's last error on this thread, e.g. "EGL_BAD_MATCH".
  static std::string lastError();

private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  std::string platform_;
};

} // namespace gnomon
