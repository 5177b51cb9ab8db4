#pragma once

#include "shadowtech/exact/CellTarget.h"
#include "shadowtech/exact/MapCasters.h"

namespace gnomon
{

/// Bakes cells of conservative maps on the GPU. The CPU clips casters and converts them to texels,
/// as drawCellsOnCpu() does. Shaders then rasterize them (CellTarget.h).
///
/// The cells equal those of the CPU, except for climb and noise of texels that a caster leaves
/// undecided; nothing reads these. All calls need the context to be current.
class CellsOnGpu
{
public:
  /// Memory limits on the GPU, in bytes.
  struct Room
  {
    /// For cells: enough for a whole map of side 2048. Larger maps are baked in parts.
    std::size_t cells = std::size_t(1) << 27;
    /// For a buffer of records, after which the next one begins. It is half of what OpenGL 4.3
    /// guarantees to shaders, so one caster's records still fit.
    std::size_t records = std::size_t(1) << 23;
  };

  /// The context must pass CellTarget::whyUnsupported().
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

  /// Bake a map's cells as drawCellsOnCpu().
  /// @throws TextureMemoryError without enough memory, std::runtime_error if OpenGL fails,
  /// std::logic_error for `Covering::Silhouette`
  bool draw(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering,
    const TakeCell& take) const;

private:
  ShaderLibrary& shaders_;
  Room room_;
};

} // namespace gnomon
