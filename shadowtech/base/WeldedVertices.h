#pragma once

#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The bits of a position. They are ordered even if the position is not finite, and equal only for
/// exactly the same place.
using Place = std::array<std::uint32_t, 3>;

inline Place placeOf(const glm::vec3& position)
{
  const glm::uvec3 bits = glm::floatBitsToUint(position + glm::vec3(0.0f)); // -0 becomes 0
  return { { bits.x, bits.y, bits.z } };
}

/// Return a hash with well-spread bits, the upper ones most.
inline std::uint64_t hashOf(const Place& place)
{
  // Two rounds of multiplication by odd numbers (Knuth, The Art of Computer Programming 3, 6.4),
  // because coordinates of regular meshes differ in few bits.
  std::uint64_t hash = (std::uint64_t(place[1]) << 32 | place[0]) * 0x9e3779b97f4a7c15u;
  hash = (hash ^ hash >> 32 ^ place[2]) * 0xd6e8feb86659fd93u;
  return hash ^ hash >> 32;
}

/// A hash table with linear probing that finds the first of equal items, numbered one by one.
class FirstOfSame
{
public:
  /// @param most upper bound of the number of items
  explicit FirstOfSame(std::size_t most)
  {
    while (std::size_t(1) << this->bits_ < 2 * most)
    {
      ++this->bits_;
    }
    this->slots_.assign(std::size_t(1) << this->bits_, empty);
  }

  /// Return the number of the first equal item, or `number` if there is none.
  /// @param hash equal for equal items
  /// @param isSame returns true if an item, given by a number passed earlier, equals this one
  template <typename IsSame>
  std::uint32_t of(std::uint32_t number, std::uint64_t hash, const IsSame& isSame)
  {
    std::size_t slot = hash >> (64 - this->bits_);
    while (this->slots_[slot] != empty && !isSame(this->slots_[slot]))
    {
      slot = (slot + 1) & (this->slots_.size() - 1);
    }
    if (this->slots_[slot] == empty)
    {
      this->slots_[slot] = number;
    }
    return this->slots_[slot];
  }

private:
  static constexpr std::uint32_t empty = 0xffffffffu;
  int bits_ = 1;
  std::vector<std::uint32_t> slots_;
};

/// Return for each vertex of a surface the first one at exactly the same place, both counted from
/// the surface's first vertex. VTK splits vertices where normals or texture coordinates break.
inline std::vector<std::uint32_t> weldedVertices(const Occluders& occluders, const Surface& surface)
{
  const glm::vec3* const positions = occluders.positionsCentred.data() + surface.firstVertex;
  std::vector<std::uint32_t> welded(surface.vertexCount);
  FirstOfSame first(welded.size());
  for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
  {
    const Place place = placeOf(positions[i]);
    welded[i] = first.of(
      i, hashOf(place), [&](std::uint32_t other) { return placeOf(positions[other]) == place; });
  }
  return welded;
}

} // namespace gnomon
