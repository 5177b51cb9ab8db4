#ifndef gnomon_plugin_MapRasterizer_h
#define gnomon_plugin_MapRasterizer_h

#include "shadowtech/base/Technique.h"
#include "shadowtech/conservative/CellTarget.h"

#include <optional>
#include <string>

namespace gnomon
{

/// Who draws conservative maps in a frame, and why.
struct RasterizerChoice
{
  std::optional<CellPath> gpu; ///< none: the CPU
  bool asked = false;          ///< and no other will do
  std::string reason;          ///< as a clause
};

/// @param wished a vtkGnomonShadowPass::RasterizerType
/// @param gpuLacks whyUnsupported(CellPath::Compute)
/// @param extensionLacks whyUnsupported(CellPath::Extension)
/// @param renderer GL_RENDERER
/// @throws std::runtime_error where the GPU is asked for and lacks something
RasterizerChoice chooseRasterizer(int wished, const std::string& gpuLacks,
  const std::string& extensionLacks, const std::string& renderer);

/// Has a technique draw its maps, conservative ones by who is chosen. Where the GPU was not asked for and fails, as for want of
/// room, the CPU takes over.
/// @return who drew them
/// @throws TextureMemoryError for maps without room, std::runtime_error where OpenGL fails
RasterizerChoice bakeMaps(Technique& technique, MapInput input, const RasterizerChoice& choice);

/// Whether a map need not be drawn anew for who is chosen now.
/// @param chosen who was to draw it
/// @param drawnBy who did
bool servesChoice(
  const RasterizerChoice& chosen, const RasterizerChoice& drawnBy, const RasterizerChoice& now);

} // namespace gnomon

#endif
