#include "plugin/frame/MapRasterizer.h"

#include <stdexcept>

namespace gnomon
{

//------------------------------------------------------------------------------
RasterizerChoice chooseRasterizer(RasterizerWish wished, const std::string& gpuLacks)
{
  if (wished == RasterizerWish::Auto)
  {
    return { false, "drawing by compute shaders is not measured faster" };
  }
  const bool gpu = wished == RasterizerWish::Gpu;
  if (gpu && !gpuLacks.empty())
  {
    throw std::runtime_error("the rasterizer on the GPU was asked for, but " + gpuLacks);
  }
  return { gpu, "asked for" };
}

} // namespace gnomon
