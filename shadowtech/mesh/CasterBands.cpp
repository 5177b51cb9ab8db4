#include "shadowtech/mesh/CasterBands.h"

namespace gnomon
{

//------------------------------------------------------------------------------
CasterPlacements::CasterPlacements(const Occluders& occluders)
  : occluders_(occluders)
{
  for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    const Surface& surface = occluders.surfaces[i];
    this->firstOfSurface_.push_back(static_cast<std::uint32_t>(this->placements_.size()));
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

//------------------------------------------------------------------------------
CasterBands::CasterBands(int size)
  : size_(size)
  , lists_([size] { return Lists(static_cast<std::size_t>((size + rows - 1) / rows)); })
{
}

//------------------------------------------------------------------------------
void CasterBands::add(double low, double high, const BandItem& item)
{
  const Span span = spanOf(low, high, this->size_);
  Lists& lists = this->lists_.local();
  for (int band = span.first / rows; band <= span.last / rows && span.first <= span.last; ++band)
  {
    lists[static_cast<std::size_t>(band)].push_back(item);
  }
}

} // namespace gnomon
