#include "shadowtech/tracing/EmbreeCallbacks.h"

#include <limits>
#include <optional>

namespace gnomon
{
namespace
{

/// Return the context that a query was made with.
template <typename Arguments>
const EmbreeContext& contextOf(const Arguments* arguments)
{
  // Embree knows the first member.
  return *reinterpret_cast<const EmbreeContext*>(arguments->context);
}

/// Reject hits on the back of a one-sided surface: those whose front does not face the light.
/// Embree's geometric normal follows counter-clockwise winding. In an instance, ray and normal are
/// in source coordinates, where a mirrored instance shows its other side.
template <bool mirrored>
void rejectBackFaces(const RTCFilterFunctionNArguments* arguments)
{
  const unsigned int count = arguments->N;
  for (unsigned int i = 0; i < count; ++i)
  {
    const float cosine =
      RTCHitN_Ng_x(arguments->hit, count, i) * RTCRayN_dir_x(arguments->ray, count, i) +
      RTCHitN_Ng_y(arguments->hit, count, i) * RTCRayN_dir_y(arguments->ray, count, i) +
      RTCHitN_Ng_z(arguments->hit, count, i) * RTCRayN_dir_z(arguments->ray, count, i);
    if (!((mirrored ? -cosine : cosine) > 0.0f))
    {
      arguments->valid[i] = 0;
    }
  }
}

template <bool mirrored>
void rejectBackFacesAndHoles(const RTCFilterFunctionNArguments* arguments)
{
  rejectBackFaces<mirrored>(arguments);
  rejectHoles(arguments);
}

void boundSolid(const RTCBoundsFunctionArguments* arguments)
{
  const auto& casters = *static_cast<const CastingSolids*>(arguments->geometryUserPtr);
  const Bounds bounds = boundsOf(casters.solids[arguments->primID]);
  const glm::vec3 lower(bounds.lower), upper(bounds.upper);
  *arguments->bounds_o = { lower.x, lower.y, lower.z, 0.0f, upper.x, upper.y, upper.z, 0.0f };
}

glm::dvec3 originOf(RTCRayN* rays, unsigned int count, unsigned int i)
{
  return { RTCRayN_org_x(rays, count, i), RTCRayN_org_y(rays, count, i),
    RTCRayN_org_z(rays, count, i) };
}

glm::dvec3 directionOf(RTCRayN* rays, unsigned int count, unsigned int i)
{
  return { RTCRayN_dir_x(rays, count, i), RTCRayN_dir_y(rays, count, i),
    RTCRayN_dir_z(rays, count, i) };
}

/// Test ray by ray, so that each ray has the same answer alone as in a packet.
void occludeBySolid(const RTCOccludedFunctionNArguments* arguments)
{
  const auto& casters = *static_cast<const CastingSolids*>(arguments->geometryUserPtr);
  const unsigned int count = arguments->N;
  for (unsigned int i = 0; i < count; ++i)
  {
    if (!arguments->valid[i])
    {
      continue;
    }
    float& far = RTCRayN_tfar(arguments->ray, count, i);
    if (blocks(casters.solids[arguments->primID], casters.oneSided,
          originOf(arguments->ray, count, i), directionOf(arguments->ray, count, i), far))
    {
      far = -std::numeric_limits<float>::infinity();
    }
  }
}

/// Shorten rays to where they enter a solid, or leave it if they begin inside.
void meetSolid(const RTCIntersectFunctionNArguments* arguments)
{
  // The surface that a ray passes through has triangles.
  if (contextOf(arguments).own)
  {
    return;
  }
  const auto& casters = *static_cast<const CastingSolids*>(arguments->geometryUserPtr);
  const unsigned int count = arguments->N;
  RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, count);
  RTCHitN* const hits = RTCRayHitN_HitN(arguments->rayhit, count);
  for (unsigned int i = 0; i < count; ++i)
  {
    if (!arguments->valid[i])
    {
      continue;
    }
    const std::optional<Crossing> crossing = crossingOf(
      casters.solids[arguments->primID], originOf(rays, count, i), directionOf(rays, count, i));
    if (!crossing)
    {
      continue;
    }
    const double near = RTCRayN_tnear(rays, count, i);
    float& far = RTCRayN_tfar(rays, count, i);
    const double at = crossing->enters > near ? crossing->enters : crossing->leaves;
    if (at > near && at < far)
    {
      far = static_cast<float>(at);
      RTCHitN_geomID(hits, count, i) = arguments->geomID;
      RTCHitN_primID(hits, count, i) = arguments->primID;
      RTCHitN_instID(hits, count, i, 0) = RTC_INVALID_GEOMETRY_ID;
    }
  }
}

} // namespace

void rejectOwn(const RTCFilterFunctionNArguments* arguments)
{
  const OwnSurface& own = *contextOf(arguments).own;
  // The ray's end is the hit's place.
  if (arguments->valid[0] && RTCRayN_tfar(arguments->ray, 1, 0) <= own.until &&
    own.has(arguments->hit))
  {
    arguments->valid[0] = 0;
  }
}

void rejectOthers(const RTCFilterFunctionNArguments* arguments)
{
  if (arguments->valid[0] && !contextOf(arguments).own->has(arguments->hit))
  {
    arguments->valid[0] = 0;
  }
}

void rejectHoles(const RTCFilterFunctionNArguments* arguments)
{
  const auto& surface = *static_cast<const CutoutSurface*>(arguments->geometryUserPtr);
  const unsigned int count = arguments->N;
  for (unsigned int i = 0; i < count; ++i)
  {
    if (!arguments->valid[i])
    {
      continue; // no hit; its numbers are undefined
    }
    const glm::uvec3 corners =
      surface.triangles[RTCHitN_primID(arguments->hit, count, i)] - surface.firstVertex;
    const glm::vec2 a = surface.textureCoordinates[corners.x];
    const glm::vec2 b = surface.textureCoordinates[corners.y];
    const glm::vec2 c = surface.textureCoordinates[corners.z];
    const float u = RTCHitN_u(arguments->hit, count, i);
    const float v = RTCHitN_v(arguments->hit, count, i);
    if (!surface.mask->isDrawn(a + u * (b - a) + v * (c - a)))
    {
      arguments->valid[i] = 0;
    }
  }
}

RTCFilterFunctionN filterOf(const Surface& surface)
{
  if (!surface.oneSided)
  {
    return surface.cutout ? rejectHoles : nullptr;
  }
  if (surface.cutout)
  {
    return surface.mirrored ? rejectBackFacesAndHoles<true> : rejectBackFacesAndHoles<false>;
  }
  return surface.mirrored ? rejectBackFaces<true> : rejectBackFaces<false>;
}

void CastingSolids::place(const Surface& surface)
{
  this->oneSided = surface.oneSided;
  this->solids.clear();
  for (const glm::mat4x3& instance : surface.centredFromSource)
  {
    if (!Surface::isLeftOut(instance))
    {
      this->solids.push_back(placedSolid(surface.solid, instance));
    }
  }
}

void setSolids(RTCGeometry geometry, CastingSolids& casters)
{
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(casters.solids.size()));
  rtcSetGeometryUserData(geometry, &casters);
  rtcSetGeometryBoundsFunction(geometry, boundSolid, nullptr);
  rtcSetGeometryOccludedFunction(geometry, occludeBySolid);
  rtcSetGeometryIntersectFunction(geometry, meetSolid);
}

} // namespace gnomon
