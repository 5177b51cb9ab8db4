#include "plugin/window/EglContext.h"

#include "shadowtech/base/System.h"

// Excludes Xlib's headers, and their macros.
#ifndef EGL_NO_X11
#define EGL_NO_X11
#endif
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gnomon
{
namespace
{

/// Versions to fall back on, best first. VTK needs 3.2, maps need 4.3.
constexpr std::array<std::pair<int, int>, 8> coreVersions{ { { 4, 5 }, { 4, 4 }, { 4, 3 }, { 4, 2 },
  { 4, 1 }, { 4, 0 }, { 3, 3 }, { 3, 2 } } };

/// A place for a context.
struct Candidate
{
  std::string name;
  EGLDisplay display;
};

bool contains(const char* extensions, const std::string& name)
{
  // Whole words only: an extension's name may begin another's.
  std::istringstream words(extensions ? extensions : "");
  for (std::string word; words >> word;)
  {
    if (word == name)
    {
      return true;
    }
  }
  return false;
}

bool clientHas(const std::string& extension)
{
  return contains(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), extension);
}

template <typename Function>
Function entryPoint(const char* name)
{
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::vector<EGLDeviceEXT> listDevices()
{
  if (!clientHas("EGL_EXT_platform_device") ||
    !(clientHas("EGL_EXT_device_enumeration") || clientHas("EGL_EXT_device_base")))
  {
    return {};
  }
  const auto queryDevices = entryPoint<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  EGLint count = 0;
  if (!queryDevices || !queryDevices(0, nullptr, &count) || count <= 0)
  {
    return {};
  }
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (!queryDevices(count, devices.data(), &count))
  {
    return {};
  }
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

bool isSoftware(EGLDeviceEXT device)
{
  const auto queryString = entryPoint<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  return queryString && contains(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

Candidate deviceCandidate(const std::vector<EGLDeviceEXT>& devices, std::size_t index)
{
  return { "EGL device " + std::to_string(index),
    eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[index], nullptr) };
}

std::vector<Candidate> listCandidates(int deviceIndex)
{
  static const long firstProcess = processNumber();
  if (processNumber() != firstProcess)
  {
    throw std::runtime_error("the process was forked after it had used EGL" + forkAdvice);
  }
  const std::vector<EGLDeviceEXT> devices = listDevices();
  if (deviceIndex >= 0)
  {
    if (static_cast<std::size_t>(deviceIndex) >= devices.size())
    {
      throw std::runtime_error("EGL device " + std::to_string(deviceIndex) +
        " was asked for, but EGL lists " + std::to_string(devices.size()) + " device(s)");
    }
    return { deviceCandidate(devices, static_cast<std::size_t>(deviceIndex)) };
  }

  std::vector<Candidate> hardware;
  std::vector<Candidate> software;
  for (std::size_t i = 0; i < devices.size(); ++i)
  {
    (isSoftware(devices[i]) ? software : hardware).push_back(deviceCandidate(devices, i));
  }
  std::vector<Candidate> candidates = std::move(hardware);
  if (clientHas("EGL_MESA_platform_surfaceless"))
  {
    candidates.push_back({ "EGL surfaceless platform",
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr) });
  }
  candidates.insert(candidates.end(), software.begin(), software.end());
  candidates.push_back({ "EGL default display", eglGetDisplay(EGL_DEFAULT_DISPLAY) });
  return candidates;
}

/// Holds an EGL display initialised. EGL gives every window the same display, so the last user
/// terminates it.
class DisplayUse
{
public:
  explicit DisplayUse(EGLDisplay display)
    : display_(display)
  {
    if (display == EGL_NO_DISPLAY)
    {
      throw std::runtime_error("there is no such display (" + EglContext::lastError() + ")");
    }
    const std::lock_guard<std::mutex> lock(mutex());
    if (users()[display] == 0 && !eglInitialize(display, nullptr, nullptr))
    {
      throw std::runtime_error("eglInitialize failed (" + EglContext::lastError() + ")");
    }
    ++users()[display];
  }
  ~DisplayUse()
  {
    const std::lock_guard<std::mutex> lock(mutex());
    if (--users()[this->display_] == 0)
    {
      eglTerminate(this->display_);
    }
  }
  DisplayUse(const DisplayUse&) = delete;
  DisplayUse& operator=(const DisplayUse&) = delete;

  EGLDisplay get() const { return this->display_; }

private:
  // Never destroyed: a window in static storage may outlive this file's own statics.
  static std::mutex& mutex()
  {
    static auto* const instance = new std::mutex;
    return *instance;
  }
  static std::map<EGLDisplay, int>& users()
  {
    static auto* const instance = new std::map<EGLDisplay, int>;
    return *instance;
  }

  EGLDisplay display_;
};

EGLContext createContext(EGLDisplay display, EGLConfig config, int majorVersion, int minorVersion)
{
  const std::array<EGLint, 7> attributes{ EGL_CONTEXT_MAJOR_VERSION, majorVersion,
    EGL_CONTEXT_MINOR_VERSION, minorVersion, EGL_CONTEXT_OPENGL_PROFILE_MASK,
    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

} // namespace

struct EglContext::Handles
{
  explicit Handles(EGLDisplay eglDisplay)
    : display(eglDisplay)
  {
  }
  ~Handles()
  {
    if (this->context != EGL_NO_CONTEXT && eglGetCurrentContext() == this->context)
    {
      eglMakeCurrent(this->display.get(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    if (this->surface != EGL_NO_SURFACE)
    {
      eglDestroySurface(this->display.get(), this->surface);
    }
    if (this->context != EGL_NO_CONTEXT)
    {
      eglDestroyContext(this->display.get(), this->context);
    }
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  void create(int majorVersion, int minorVersion)
  {
    if (!eglBindAPI(EGL_OPENGL_API))
    {
      throw std::runtime_error("EGL has no OpenGL here (" + lastError() + ")");
    }
    const std::array<EGLint, 5> wanted{ EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
      EGL_OPENGL_BIT, EGL_NONE };
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(this->display.get(), wanted.data(), &config, 1, &count) || count == 0)
    {
      throw std::runtime_error("no EGL configuration serves OpenGL (" + lastError() + ")");
    }
    this->context = createContext(this->display.get(), config, majorVersion, minorVersion);
    for (const auto& [lowerMajor, lowerMinor] : coreVersions)
    {
      if (this->context == EGL_NO_CONTEXT &&
        std::make_pair(lowerMajor, lowerMinor) < std::make_pair(majorVersion, minorVersion))
      {
        this->context = createContext(this->display.get(), config, lowerMajor, lowerMinor);
      }
    }
    if (this->context == EGL_NO_CONTEXT)
    {
      throw std::runtime_error("no OpenGL core context, neither " + std::to_string(majorVersion) +
        "." + std::to_string(minorVersion) + " nor lower down to 3.2 (" + lastError() + ")");
    }
    if (!contains(
          eglQueryString(this->display.get(), EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
    {
      // Nothing is drawn into it, but these drivers make no context current without a surface.
      const std::array<EGLint, 5> size{ EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE };
      this->surface = eglCreatePbufferSurface(this->display.get(), config, size.data());
    }
    GlxContext::release();
    if (!eglMakeCurrent(this->display.get(), this->surface, this->surface, this->context))
    {
      throw std::runtime_error("the context cannot be made current (" + lastError() + ")");
    }
  }

  DisplayUse display;
  long process = processNumber();
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface surface = EGL_NO_SURFACE;
};

EglContext::EglContext(const EglRequest& request)
{
  std::string reasons;
  for (const Candidate& candidate : listCandidates(request.deviceIndex))
  {
    try
    {
      auto handles = std::make_unique<Handles>(candidate.display);
      handles->create(request.majorVersion, request.minorVersion);
      this->handles_ = std::move(handles);
      this->platform_ = candidate.name;
      return;
    }
    catch (const std::runtime_error& error)
    {
      reasons += (reasons.empty() ? "" : "; ") + candidate.name + ": " + error.what();
    }
  }
  throw std::runtime_error(reasons);
}

EglContext::~EglContext()
{
  if (!this->isOfThisProcess())
  {
    static_cast<void>(this->handles_.release()); // whose destruction would wait for threads
  }
}

bool EglContext::makeCurrent() const
{
  if (this->isCurrent())
  {
    return true;
  }
  GlxContext::release();
  return eglMakeCurrent(this->handles_->display.get(), this->handles_->surface,
    this->handles_->surface, this->handles_->context);
}

bool EglContext::isCurrent() const
{
  return this->isOfThisProcess() && eglGetCurrentContext() == this->handles_->context;
}

void EglContext::release() const
{
  eglMakeCurrent(this->handles_->display.get(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

bool EglContext::isOfThisProcess() const
{
  return this->handles_->process == processNumber();
}

void* EglContext::display() const
{
  return this->handles_->display.get();
}

void* EglContext::context() const
{
  return this->handles_->context;
}

int EglContext::numberOfDevices()
{
  return static_cast<int>(listDevices().size());
}

std::string EglContext::lastError()
{
  static const std::map<EGLint, const char*> names = {
    { EGL_SUCCESS, "EGL gives no reason" },
    { EGL_NOT_INITIALIZED, "EGL_NOT_INITIALIZED" },
    { EGL_BAD_ACCESS, "EGL_BAD_ACCESS" },
    { EGL_BAD_ALLOC, "EGL_BAD_ALLOC" },
    { EGL_BAD_ATTRIBUTE, "EGL_BAD_ATTRIBUTE" },
    { EGL_BAD_CONFIG, "EGL_BAD_CONFIG" },
    { EGL_BAD_CONTEXT, "EGL_BAD_CONTEXT" },
    { EGL_BAD_DISPLAY, "EGL_BAD_DISPLAY" },
    { EGL_BAD_MATCH, "EGL_BAD_MATCH" },
    { EGL_BAD_PARAMETER, "EGL_BAD_PARAMETER" },
    { EGL_BAD_SURFACE, "EGL_BAD_SURFACE" },
    { EGL_CONTEXT_LOST, "EGL_CONTEXT_LOST" },
  };
  const EGLint error = eglGetError();
  const auto name = names.find(error);
  return name != names.end() ? name->second : "EGL error " + std::to_string(error);
}

void (*EglContext::findFunction(const char* name))()
{
  return eglGetProcAddress(name);
}

CurrentContext::CurrentContext()
  : display_(eglGetCurrentDisplay())
  , draw_(eglGetCurrentSurface(EGL_DRAW))
  , read_(eglGetCurrentSurface(EGL_READ))
  , context_(eglGetCurrentContext())
{
}

CurrentContext::~CurrentContext()
{
  const EGLContext current = eglGetCurrentContext();
  if (this->context_ != current)
  {
    eglMakeCurrent(this->context_ != EGL_NO_CONTEXT ? this->display_ : eglGetCurrentDisplay(),
      this->draw_, this->read_, this->context_);
  }
}

} // namespace gnomon
