#include "plugin/MapRasterizer.h"

#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/conservative/CellsOnGpu.h"
#include "shadowtech/tracing/GpuTracer.h"

#include <stdexcept>

namespace gnomon
{

//------------------------------------------------------------------------------
RasterizerChoice chooseRasterizer(int wished, const std::string& gpuLacks,
  const std::string& extensionLacks, const std::string& renderer)
{
  if (wished == vtkGnomonShadowPass::RASTERIZER_CPU)
  {
    return { std::nullopt, true, "asked for" };
  }
  if (wished == vtkGnomonShadowPass::RASTERIZER_GPU)
  {
    if (!gpuLacks.empty())
    {
      throw std::runtime_error("the rasterizer on the GPU was asked for, but " + gpuLacks);
    }
    return { extensionLacks.empty() ? CellPath::Extension : CellPath::Compute, true, "asked for" };
  }
  if (isSoftwareRenderer(renderer))
  {
    return { std::nullopt, false, "OpenGL draws by software: " + renderer };
  }
  // Nothing has shown yet that compute shaders are worth their while.
  return extensionLacks.empty()
    ? RasterizerChoice{ CellPath::Extension, false, "OpenGL draws by hardware: " + renderer }
    : RasterizerChoice{ std::nullopt, false, extensionLacks };
}

//------------------------------------------------------------------------------
RasterizerChoice bakeMaps(Technique& technique, MapInput input, const RasterizerChoice& choice)
{
  if (!choice.gpu)
  {
    technique.bake(input);
    return choice;
  }
  const CellsOnGpu cells(input.shaders, *choice.gpu);
  input.cellsOnGpu = &cells;
  try
  {
    technique.bake(input);
    return choice;
  }
  catch (const std::runtime_error& error)
  {
    if (choice.asked)
    {
      throw;
    }
    input.cellsOnGpu = nullptr;
    technique.bake(input);
    return { std::nullopt, false, std::string("drawing maps on the GPU failed: ") + error.what() };
  }
}

//------------------------------------------------------------------------------
bool servesChoice(
  const RasterizerChoice& chosen, const RasterizerChoice& drawnBy, const RasterizerChoice& now)
{
  // Where the GPU failed and was not asked for, it is not tried again.
  return drawnBy.gpu == now.gpu || (!now.asked && chosen.gpu == now.gpu);
}

} // namespace gnomon
