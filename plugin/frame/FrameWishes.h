#pragma once

#include "plugin/frame/CostModel.h"

#include <optional>

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
  double memoryBudget = 0.0;     ///< bytes of lights' maps and images of visibility; 0: none
  bool smoothTerminators = true; ///< whether receivers may be on the surface that normals imply
  ///@{
  /// Of lights that leave their technique to the pass.
  bool moves = false;             ///< whether the picture moves; at rest they are exact
  bool mayRefine = false;         ///< whether more frames at rest follow if this one is incomplete
  double maximumError = 0.005;    ///< share of wrong pixels of hard shadows, in frames that move
  double maximumSoftError = 0.03; ///< root mean square error of soft ones
  double timeBudget = 0.0;        ///< milliseconds for a frame that moves; 0: none
  std::optional<CostFactors> factors; ///< of this machine; none: the default ones
  ///@}
};

} // namespace gnomon
