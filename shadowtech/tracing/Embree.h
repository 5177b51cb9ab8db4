#pragma once

// Embree 3 or 4, by names that fit both. No other file includes Embree's headers.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace gnomon
{

struct OwnSurface;

/// The kind of rays that Embree may optimise traversal for.
enum class EmbreeRays
{
  Incoherent,
  Coherent
};

#if RTC_VERSION_MAJOR >= 4

/// The arguments of a query besides its rays. Callbacks receive the address of the first member.
struct EmbreeContext
{
  explicit EmbreeContext(EmbreeRays rays = EmbreeRays::Incoherent)
    : flags(
        rays == EmbreeRays::Coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT)
  {
    rtcInitRayQueryContext(&this->context);
  }

  RTCRayQueryContext context;
  RTCRayQueryFlags flags;
  RTCFilterFunctionN filter = nullptr; ///< of this query alone, in scenes with `queriesFilter`
  const OwnSurface* own = nullptr;     ///< the surface that the filter asks about
};

inline constexpr RTCSceneFlags queriesFilter = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

template <typename Arguments>
void setArguments(Arguments& arguments, EmbreeContext& context)
{
  arguments.flags = context.filter
    ? static_cast<RTCRayQueryFlags>(context.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER)
    : context.flags;
  arguments.filter = context.filter;
  arguments.context = &context.context;
}

inline void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& query)
{
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  setArguments(arguments, context);
  rtcIntersect1(scene, &query, &arguments);
}

inline RTCOccludedArguments occludedArguments(EmbreeContext& context)
{
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  setArguments(arguments, context);
  return arguments;
}

inline void occlude(RTCScene scene, EmbreeContext& context, RTCRay& ray)
{
  RTCOccludedArguments arguments = occludedArguments(context);
  rtcOccluded1(scene, &ray, &arguments);
}

inline void occlude(const int* valid, RTCScene scene, EmbreeContext& context, RTCRay8& rays)
{
  RTCOccludedArguments arguments = occludedArguments(context);
  rtcOccluded8(valid, scene, &rays, &arguments);
}

inline void occlude(const int* valid, RTCScene scene, EmbreeContext& context, RTCRay16& rays)
{
  RTCOccludedArguments arguments = occludedArguments(context);
  rtcOccluded16(valid, scene, &rays, &arguments);
}

#else

/// The arguments of a query besides its rays. Callbacks receive the address of the first member.
struct EmbreeContext
{
  explicit EmbreeContext(EmbreeRays rays = EmbreeRays::Incoherent)
  {
    rtcInitIntersectContext(&this->context);
    this->context.flags = rays == EmbreeRays::Coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                       : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  RTCIntersectContext context;
  RTCFilterFunctionN filter = nullptr; ///< of this query alone, in scenes with `queriesFilter`
  const OwnSurface* own = nullptr;     ///< the surface that the filter asks about
};

inline constexpr RTCSceneFlags queriesFilter = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& query)
{
  context.context.filter = context.filter;
  rtcIntersect1(scene, &context.context, &query);
}

inline void occlude(RTCScene scene, EmbreeContext& context, RTCRay& ray)
{
  context.context.filter = context.filter;
  rtcOccluded1(scene, &context.context, &ray);
}

inline void occlude(const int* valid, RTCScene scene, EmbreeContext& context, RTCRay8& rays)
{
  rtcOccluded8(valid, scene, &context.context, &rays);
}

inline void occlude(const int* valid, RTCScene scene, EmbreeContext& context, RTCRay16& rays)
{
  rtcOccluded16(valid, scene, &context.context, &rays);
}

#endif

} // namespace gnomon
