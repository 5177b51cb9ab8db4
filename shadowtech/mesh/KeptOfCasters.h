#pragma once

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon
{

/// A cache of one value per casting surface, reused across snapshots.
/// @tparam Found the value; its bytes() returns the memory it owns elsewhere
template <typename Found>
class KeptOfCasters
{
public:
  /// Compute the values of new surfaces, and update those of surfaces that moved or have another
  /// place in the snapshot.
  /// @param bringUpToDate called with a snapshot, one of its surfaces, and the value cached for the
  /// same triangles, or an empty Found
  template <typename BringUpToDate>
  void update(const Occluders& occluders, const BringUpToDate& bringUpToDate)
  {
    // If an update throws, the cache stays consistent, and missing values are computed next time.
    std::unordered_map<std::uint64_t, Kept> earlier = std::exchange(this->kept_, {});
    this->bySurface_.assign(occluders.surfaces.size(), nullptr);
    for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
    {
      const Surface& surface = occluders.surfaces[i];
      if (!surface.casts)
      {
        continue;
      }
      Kept kept;
      const auto before = earlier.find(surface.topologyVersion);
      const bool isNew = before == earlier.end();
      if (!isNew)
      {
        kept = std::move(before->second);
      }
      if (isNew || kept.positionsVersion != surface.positionsVersion ||
        kept.firstVertex != surface.firstVertex || kept.firstTriangle != surface.firstTriangle)
      {
        bringUpToDate(occluders, surface, kept.found);
        kept.positionsVersion = surface.positionsVersion;
        kept.firstVertex = surface.firstVertex;
        kept.firstTriangle = surface.firstTriangle;
      }
      // The table's elements never move.
      this->bySurface_[i] =
        &this->kept_.emplace(surface.topologyVersion, std::move(kept)).first->second.found;
    }
  }

  /// Return the value of a casting surface.
  /// @param surface index into the snapshot's surfaces, as of the last update
  const Found& of(std::size_t surface) const { return *this->bySurface_[surface]; }

  std::size_t bytes() const
  {
    return bytesOfTable(this->kept_) + bytesOf(this->bySurface_) +
      bytesOfAll(this->kept_, [](const auto& entry) { return entry.second.found.bytes(); });
  }

private:
  struct Kept
  {
    std::uint64_t positionsVersion = 0;
    std::uint32_t firstVertex = 0;
    std::uint32_t firstTriangle = 0;
    Found found;
  };
  std::unordered_map<std::uint64_t, Kept> kept_; ///< by a surface's topologyVersion
  std::vector<const Found*> bySurface_;
};

} // namespace gnomon
