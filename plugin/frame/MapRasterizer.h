#pragma once

#include "plugin/frame/FrameWishes.h"

#include <string>

namespace gnomon
{

/// Who draws conservative maps, and why.
struct RasterizerChoice
{
  bool gpu = false;   ///< false: the CPU
  std::string reason; ///< as a clause
};

/// Choose who draws the conservative maps of a frame.
/// @param gpuLacks CellTarget::whyUnsupported()
/// @throws std::runtime_error where the GPU is asked for and lacks something
RasterizerChoice chooseRasterizer(RasterizerWish wished, const std::string& gpuLacks);

} // namespace gnomon
