#pragma once

namespace gnomon
{

/// How visibility is to reach the picture.
enum class RouteWish
{
  Auto,
  Inline,
  Image,
  Deferred
};

/// What traces rays.
enum class TracerWish
{
  Auto,
  Embree,
  Gpu
};

/// What draws conservative maps.
enum class RasterizerWish
{
  Auto,
  Cpu,
  Gpu
};

/// What the pass is set to for a frame.
struct FrameWishes
{
  RouteWish route = RouteWish::Auto;
  TracerWish tracer = TracerWish::Auto;
  RasterizerWish rasterizer = RasterizerWish::Auto;
  bool keepVisibility = false; ///< whether visibility is asked for as data
  bool measureStages = false;
  bool smoothTerminators = true; ///< whether receivers may be on the surface that normals imply
};

} // namespace gnomon
