#pragma once

#include "plugin/window/GlxContext.h"

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
  /// Leave this thread without a context of EGL.
  void release() const;
  /// True if the process was not forked since.
  bool isOfThisProcess() const;
  void* display() const;
  void* context() const;
  /// Return the context's place for display: "EGL device 0", "EGL surfaceless platform", ...
  const std::string& platform() const { return this->platform_; }

  /// Return the number of devices that EGL lists; 0 if it cannot list them.
  static int numberOfDevices();
  /// Return the name of EGL's last error on this thread, e.g. "EGL_BAD_MATCH".
  static std::string lastError();
  /// Return a function of the current context; null if it has none of that name.
  static void (*findFunction(const char* name))();

private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  std::string platform_;
};

/// Remembers this thread's current context, of EGL or GLX, or that it has none, and restores that
/// on destruction.
class CurrentContext
{
public:
  CurrentContext();
  ~CurrentContext();
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

private:
  GlxContext glx_; ///< restored after EGL's
  void* display_;
  void* draw_;
  void* read_;
  void* context_;
};

} // namespace gnomon
