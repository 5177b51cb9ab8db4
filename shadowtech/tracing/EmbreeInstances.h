#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/tracing/EmbreeHandle.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon
{

/// Attach a structure to a scene once for each instance of a surface. placeInstances() places them.
/// @return Embree's numbers; RTC_INVALID_GEOMETRY_ID for instances that are left out
inline std::vector<unsigned int> attachInstances(
  RTCDevice device, RTCScene scene, RTCScene source, const Surface& surface)
{
  std::vector<unsigned int> attached;
  attached.reserve(surface.centredFromSource.size());
  for (const glm::mat4x3& instance : surface.centredFromSource)
  {
    if (Surface::isLeftOut(instance))
    {
      attached.push_back(RTC_INVALID_GEOMETRY_ID);
      continue;
    }
    const EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), source);
    attached.push_back(rtcAttachGeometry(scene, geometry.get()));
  }
  return attached;
}

/// Give a surface's attached instances their present places.
inline void placeInstances(
  RTCScene scene, const std::vector<unsigned int>& attached, const Surface& surface)
{
  for (std::size_t i = 0; i < attached.size(); ++i)
  {
    if (attached[i] != RTC_INVALID_GEOMETRY_ID)
    {
      const RTCGeometry geometry = rtcGetGeometry(scene, attached[i]);
      rtcSetGeometryTransform(
        geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &surface.centredFromSource[i][0][0]);
      rtcCommitGeometry(geometry);
    }
  }
}

/// Detach what is attached to a scene by these numbers; invalid ones are passed over.
inline void detachAll(RTCScene scene, const std::vector<unsigned int>& attached)
{
  for (const unsigned int number : attached)
  {
    if (number != RTC_INVALID_GEOMETRY_ID)
    {
      rtcDetachGeometry(scene, number);
    }
  }
}

} // namespace gnomon
