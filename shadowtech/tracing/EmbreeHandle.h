#pragma once

#include "shadowtech/tracing/Embree.h"

#include <utility>

namespace gnomon
{

/// Owns one reference to an Embree object.
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

} // namespace gnomon
