#pragma once

#include "lights/Bounds.h"
#include "shadowtech/tracing/Embree.h"

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace gnomon
{

template <typename Object, void (*release)(Object)>
class EmbreeHandle
{
public:
  EmbreeHandle() = default;
  explicit EmbreeHandle(Object object)
    : object_(object)
  {
  }
  EmbreeHandle(EmbreeHandle&& other) noexcept
    : object_(std::exchange(other.object_, nullptr))
  {
  }
  EmbreeHandle& operator=(EmbreeHandle&& other) noexcept
  {
    std::swap(this->object_, other.object_);
    return *this;
  }
  ~EmbreeHandle()
  {
    if (this->object_)
    {
      release(this->object_);
    }
  }
  Object get() const { return this->object_; }

private:
  Object object_ = nullptr;
};

using EmbreeDevice = EmbreeHandle<RTCDevice, rtcReleaseDevice>;
using EmbreeScene = EmbreeHandle<RTCScene, rtcReleaseScene>;
using EmbreeGeometry = EmbreeHandle<RTCGeometry, rtcReleaseGeometry>;
using EmbreeBvh = EmbreeHandle<RTCBVH, rtcReleaseBVH>;

/// Return a new device. A start that fails for want of memory leaves Embree locked, and the release
/// of a later device would wait for ever. So Embree is not asked again after a failure.
/// @throws std::runtime_error if Embree cannot be started
inline EmbreeDevice startEmbree()
{
  static std::atomic<bool> hasFailed{ false };
  EmbreeDevice device(hasFailed ? nullptr : rtcNewDevice(nullptr));
  if (!device.get())
  {
    hasFailed = true;
    throw std::runtime_error("Embree cannot be started in this process");
  }
  return device;
}

/// Count the bytes that a device allocates.
/// @param bytes must outlive the device
inline void countBytes(RTCDevice device, std::atomic<std::ptrdiff_t>& bytes)
{
  rtcSetDeviceMemoryMonitorFunction(
    device,
    [](void* user, ssize_t change, bool)
    {
      *static_cast<std::atomic<std::ptrdiff_t>*>(user) += change;
      return true;
    },
    &bytes);
}

/// Let nothing pass that Embree ignores (triangles) or dies of (boxes of its builder).
/// @param bounds of what casts
/// @throws std::runtime_error if it is beyond the range of Embree
inline void checkEmbreeRange(const Bounds& bounds)
{
  constexpr double largest = 1.8e18; // its square is a float
  if (!isWithin(bounds, largest))
  {
    throw std::runtime_error("casters lie more than 1.8e18 units off the scene's centre");
  }
}

} // namespace gnomon
