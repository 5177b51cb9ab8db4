#include "plugin/frame/MapRasterizer.h"

#include "plugin/vtkGnomonShadowPass.h"

#include <stdexcept>

namespace gnomon
{

//------------------------------------------------------------------------------
RasterizerChoice chooseRasterizer(int wished, const std::string& gpuLacks)
{
  if (wished == vtkGnomonShadowPass::RASTERIZER_AUTO)
  {
    return { false, "drawing by compute shaders is not measured faster" };
  }
  const bool gpu = wished == vtkGnomonShadowPass::RASTERIZER_GPU;
  if (gpu && !gpuLacks.empty())
  {
    throw std::runtime_error("the rasterizer on the GPU was asked for, but " + gpuLacks);
  }
  return { gpu, "asked for" };
}

} // namespace gnomon
