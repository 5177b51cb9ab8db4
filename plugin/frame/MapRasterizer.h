#pragma once

#include "plugin/frame/FrameWishes.h"

#include <string>

namespace gnomon
{

/// The rasterizer of conservative maps, and why.
struct RasterizerChoice
{
  bool gpu = false;   ///< false: the CPU
  std::string reason; ///< as a clause
};

/// Return the rasterizer of a frame's conservative maps.
/// @param gpuLacks CellTarget::whyUnsupported()
/// @throws std::runtime_error if the GPU is asked for and lacks a feature
RasterizerChoice chooseRasterizer(RasterizerWish wished, const std::string& gpuLacks);

} // namespace gnomon
