#ifndef gnomon_shadowtech_conservative_CellsOnGpu_h
#define gnomon_shadowtech_conservative_CellsOnGpu_h

#include "shadowtech/conservative/CellTarget.h"
#include "shadowtech/conservative/MapCasters.h"

namespace gnomon
{

/// Draws conservative maps' cells on the GPU. The CPU looks at casters as it does where it draws them, and makes them ready for
/// the texels; which texels they meet and what these keep is found by shaders (CellTarget.h), which get the same cells.
/// All calls want the context to be current.
class CellsOnGpu
{
public:
  /// Enough for all of a map of 2048; larger ones are drawn in parts.
  static constexpr std::size_t mostBytesOfCells = std::size_t(1) << 27;

  /// @param shaders must outlive this
  /// @param path one that is supported
  /// @param mostBytes that cells may take on the GPU at once
  CellsOnGpu(ShaderLibrary& shaders, CellPath path, std::size_t mostBytes = mostBytesOfCells)
    : shaders_(shaders)
    , path_(path)
    , mostBytes_(mostBytes)
  {
  }

  /// As drawCellsOnCpu(); not for `Covering::Silhouette`.
  /// @throws TextureMemoryError where there is no room
  bool draw(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering,
    const TakeCell& take) const;

private:
  ShaderLibrary& shaders_;
  CellPath path_;
  std::size_t mostBytes_;
};

} // namespace gnomon

#endif
