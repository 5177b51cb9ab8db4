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
  /// @param shaders must outlive this
  /// @param path one that is supported
  CellsOnGpu(ShaderLibrary& shaders, CellPath path)
    : shaders_(shaders)
    , path_(path)
  {
  }

  CellPath path() const { return this->path_; }

  /// As drawCellsOnCpu(); not for `Covering::Silhouette`.
  /// @throws TextureMemoryError where there is no room
  bool draw(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering,
    const TakeCell& take) const;

private:
  ShaderLibrary& shaders_;
  CellPath path_;
};

} // namespace gnomon

#endif
