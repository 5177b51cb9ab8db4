#ifndef gnomon_shadowtech_conservative_KeptOfCasters_h
#define gnomon_shadowtech_conservative_KeptOfCasters_h

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon
{

/// Something that is found once for each casting surface, and kept from snapshot to snapshot.
template <typename Found>
class KeptOfCasters
{
public:
  /// Finds it for surfaces that are new, or whose vertices moved.
  /// @param find called with a snapshot and a surface of it
  template <typename Find>
  void update(const Occluders& occluders, const Find& find)
  {
    // Should finding fail, what was kept is whole, and the rest will be found again.
    std::unordered_map<std::uint64_t, Kept> earlier = std::exchange(this->kept_, {});
    this->bySurface_.assign(occluders.surfaces.size(), nullptr);
    for (const Surface& surface : occluders.surfaces)
    {
      if (!surface.casts)
      {
        continue;
      }
      const auto before = earlier.find(surface.topologyVersion);
      // Of a surface that only moves, vertices that shared a place still do, and angles stay; of one
      // that is deformed they need not. Both are new positions.
      if (before != earlier.end() && before->second.positionsVersion == surface.positionsVersion &&
        before->second.firstVertex == surface.firstVertex &&
        before->second.firstTriangle == surface.firstTriangle)
      {
        this->kept_.emplace(surface.topologyVersion, std::move(before->second));
      }
      else
      {
        this->kept_.emplace(surface.topologyVersion,
          Kept{ surface.positionsVersion, surface.firstVertex, surface.firstTriangle,
            find(occluders, surface) });
      }
    }
    for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
    {
      if (occluders.surfaces[i].casts)
      {
        this->bySurface_[i] = &this->kept_.at(occluders.surfaces[i].topologyVersion).found;
      }
    }
  }

  /// Of a casting surface.
  /// @param surface index into the snapshot's surfaces, as of the last update
  const Found& of(std::size_t surface) const { return *this->bySurface_[surface]; }

  /// @param bytesOfFound what one of them holds elsewhere
  template <typename BytesOfFound>
  std::size_t bytes(const BytesOfFound& bytesOfFound) const
  {
    std::size_t bytes = bytesOfTable(this->kept_) + bytesOf(this->bySurface_);
    for (const auto& entry : this->kept_)
    {
      bytes += bytesOfFound(entry.second.found);
    }
    return bytes;
  }

private:
  struct Kept
  {
    std::uint64_t positionsVersion = 0;
    std::uint32_t firstVertex = 0;
    std::uint32_t firstTriangle = 0;
    Found found;
  };
  std::unordered_map<std::uint64_t, Kept> kept_; ///< by the surface's topologyVersion
  std::vector<const Found*> bySurface_;
};

} // namespace gnomon

#endif
