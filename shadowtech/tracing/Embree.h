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

#if RTC_VERSION_MAJOR >= 4

/// The arguments of a query besides its rays. Callbacks receive the address of the first member.
struct EmbreeContext
{
  EmbreeContext() { rtcInitRayQueryContext(&this->context); }

  RTCRayQueryContext context;
  RTCFilterFunctionN filter = nullptr; ///< of this query alone, in scenes with `queriesFilter`
  const OwnSurface* own = nullptr;     ///< the surface that the filter asks about
};

inline constexpr RTCSceneFlags queriesFilter = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

template <typename Arguments>
void setArguments(Arguments& arguments, EmbreeContext& context)
{
  // Incoherent is no bit of its own.
  arguments.flags =
    context.filter ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : RTC_RAY_QUERY_FLAG_INCOHERENT;
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
  EmbreeContext()
  {
    rtcInitIntersectContext(&this->context);
    this->context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
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
