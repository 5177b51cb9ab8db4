#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace gnomon
{

struct Occluders;
struct Surface;

/// A surface's parts that shared edges connect, and its normals that imply no curve. Found when
/// first asked for, by several threads at once. For instances all of this is in source coordinates.
class Patches
{
public:
  /// Return a number for each of the surface's triangles, the same for connected ones. Edges are
  /// shared if their ends have the same coordinates, so the seam of a texture connects, too.
  const std::vector<std::uint32_t>& numbers(const Occluders& occluders, const Surface& surface);

  /// True if a triangle has a corner whose normal is too far off (leastCosineOfCurve) a facet that
  /// shares it. A normal that is averaged over an edge of more than 84 degrees is.
  /// @param triangle of the snapshot
  bool isAtCrease(const Occluders& occluders, const Surface& surface, std::uint32_t triangle);

  std::size_t bytes() const;

private:
  std::mutex mutex_;
  std::atomic<std::uint64_t> positionsVersion_{ 0xffffffffffffffff }; ///< of creased_
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint8_t> creased_; ///< by vertex: 1 or 0
};

/// A surface's identity in all processes that draw a picture. All blocks of a prop are one.
using SharedName = std::array<std::int64_t, 4>;
/// Names a patch in all processes that draw a picture, by one of its triangles in one of them.
struct PatchName
{
  std::uint32_t process;
  std::uint32_t triangle; ///< of the process's snapshot

  bool operator==(const PatchName& other) const
  {
    return this->process == other.process && this->triangle == other.triangle;
  }
  bool operator<(const PatchName& other) const
  {
    return this->process != other.process ? this->process < other.process
                                          : this->triangle < other.triangle;
  }
};
/// By surface of this process, the names of its triangles' patches; empty for surfaces that no
/// receiver with a curve is on.
using PatchNames = std::vector<std::vector<PatchName>>;

} // namespace gnomon
