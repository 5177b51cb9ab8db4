#pragma once

#include "shadowtech/exact/CellTarget.h"
#include "shadowtech/exact/MapCasters.h"

namespace gnomon
{

/// Draws conservative maps' cells on the GPU. The CPU looks at casters as it does where it draws
/// them, and makes them ready for the texels; which texels they meet and what these keep is found
/// by shaders (CellTarget.h), which get the same cells, but for G and noise of texels that a caster
/// has spoilt: nothing asks for these. All calls want the context to be current.
class CellsOnGpu
{
public:
  /// What is on the GPU at once, in bytes.
  struct Room
  {
    /// Of cells: enough for all of a map of 2048; larger ones are drawn in parts.
    std::size_t cells = std::size_t(1) << 27;
    /// Of what they are drawn from, in one buffer, before another is begun: half of what shaders
    /// read at least, by OpenGL 4.3, so that what a single caster's part adds has room.
    std::size_t records = std::size_t(1) << 23;
  };

  /// The context must support them (CellTarget::whyUnsupported()).
  /// @param shaders must outlive this
  explicit CellsOnGpu(ShaderLibrary& shaders)
    : CellsOnGpu(shaders, Room())
  {
  }
  CellsOnGpu(ShaderLibrary& shaders, const Room& room)
    : shaders_(shaders)
    , room_(room)
  {
  }

  /// As drawCellsOnCpu().
  /// @throws TextureMemoryError where there is no room, std::runtime_error where OpenGL fails,
  /// std::logic_error for `Covering::Silhouette`
  bool draw(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering,
    const TakeCell& take) const;

private:
  ShaderLibrary& shaders_;
  Room room_;
};

} // namespace gnomon
