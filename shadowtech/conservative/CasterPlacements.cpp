#include "shadowtech/conservative/CasterPlacements.h"

namespace gnomon
{

//------------------------------------------------------------------------------
CasterPlacements::CasterPlacements(const Occluders& occluders)
  : occluders_(occluders)
{
  for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    const Surface& surface = occluders.surfaces[i];
    const std::size_t instances = surface.isInstanced() ? surface.centredFromSource.size() : 1;
    for (std::size_t instance = 0; surface.casts && instance < instances; ++instance)
    {
      if (!surface.isInstanced() || !Surface::isLeftOut(surface.centredFromSource[instance]))
      {
        this->placements_.push_back({ static_cast<std::uint32_t>(i),
          static_cast<std::uint32_t>(instance), this->triangleCount_ });
        this->triangleCount_ += surface.triangleCount;
      }
    }
  }
}

} // namespace gnomon
