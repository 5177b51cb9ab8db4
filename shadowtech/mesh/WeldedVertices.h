#pragma once

#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// A position as bits: in order even where it is not finite, and the same only for exactly the same
/// place.
using Place = std::array<std::uint32_t, 3>;

inline Place placeOf(const glm::vec3& position)
{
  const glm::uvec3 bits = glm::floatBitsToUint(position + glm::vec3(0.0f)); // -0 becomes 0
  return { { bits.x, bits.y, bits.z } };
}

/// Well spread over all of its bits, the upper ones most.
inline std::uint64_t hashOf(const Place& place)
{
  // Two rounds of multiplication by odd numbers (Knuth, The Art of Computer Programming 3, 6.4):
  // coordinates of regular meshes differ in few bits.
  std::uint64_t hash = (std::uint64_t(place[1]) << 32 | place[0]) * 0x9e3779b97f4a7c15u;
  hash = (hash ^ hash >> 32 ^ place[2]) * 0xd6e8feb86659fd93u;
  return hash ^ hash >> 32;
}

/// Of things that are numbered one by one, finds the first that is the same: a hash table of their
/// numbers, with linear probing.
class FirstOfSame
{
public:
  /// @param most how many things there can be
  explicit FirstOfSame(std::size_t most)
  {
    while (std::size_t(1) << this->bits_ < 2 * most)
    {
      ++this->bits_;
    }
    this->slots_.assign(std::size_t(1) << this->bits_, empty);
  }

  /// @param hash the same for things that are the same
  /// @param isSame whether a thing of that number, of those asked for before, is the same as this
  /// one
  /// @return the number of the first one; this one, if there was none
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

/// For each vertex of a surface, counted from its first, the first one at exactly the same place:
/// surfaces that are drawn are split where their normals or texture coordinates break.
std::vector<std::uint32_t> weldedVertices(const Occluders& occluders, const Surface& surface);

} // namespace gnomon
