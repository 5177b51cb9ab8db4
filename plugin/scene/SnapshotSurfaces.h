#pragma once

#include "plugin/scene/WantedSurfaces.h"

#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

/// How many instances a process has of a glyph. Glyphs of several processes are one if the rest is
/// equal.
struct GlyphCount
{
  std::int64_t prop; ///< DrawnProp::number
  std::int64_t path; ///< DrawnProp::path
  std::int64_t source;
  std::int64_t cells; ///< SurfaceCells
  std::int64_t instances;

  bool isSameGlyph(const GlyphCount& other) const
  {
    return this->prop == other.prop && this->path == other.path && this->source == other.source &&
      this->cells == other.cells;
  }
};

/// What other processes hold of the scene, from what this one does. Empty: there are no others.
struct OtherParts
{
  std::function<Bounds(const Bounds&)> unite; ///< the box around all
  std::function<std::vector<GlyphCount>(const std::vector<GlyphCount>&)> gather; ///< those of all
};

/// The result of one update of the snapshot.
struct SnapshotChange
{
  int extracted = 0;     ///< surfaces that were read from their mapper's input
  int retransformed = 0; ///< surfaces whose centred positions were recomputed
  bool any = false;      ///< true if any surface is new, gone, changed or moved
};

/// The surfaces in the snapshot, with a record of each. An update leaves unchanged surfaces alone,
/// transforms moved ones in place, and rebuilds the list only if triangles changed.
class SnapshotSurfaces
{
public:
  /// Make the snapshot hold these surfaces, in this order.
  /// @param others from all bounds follows the centre, from all counts which glyphs are instances
  SnapshotChange update(std::vector<WantedSurface>& wanted, const OtherParts& others);

  const Occluders& occluders() const { return this->occluders_; }
  /// Return the records, one for each of the snapshot's surfaces.
  const std::vector<SurfaceRecord>& records() const { return this->records_; }
  std::size_t bytes() const;

private:
  /// A surface's change since the last frame.
  enum class Outcome
  {
    Same,
    Moved,         ///< the same triangles at other positions, already written to the snapshot
    OtherTriangles ///< waits in WantedSurface::fresh
  };

  int countInstances(std::vector<WantedSurface>& wanted, const OtherParts& others);
  bool updateCentre(const std::vector<WantedSurface>& wanted, const OtherParts& others);
  void read(WantedSurface& wanted, vtkMTimeType time);
  Outcome updateSurface(WantedSurface& wanted, bool recentred, SnapshotChange& change);
  bool transformAgain(const WantedSurface& wanted);
  bool moveInstances(std::size_t index, PlacedInstances& placed);
  Outcome overwrite(WantedSurface& wanted);
  void rebuild(std::vector<WantedSurface>& wanted);
  bool updateFlags(const std::vector<WantedSurface>& wanted);
  void summarise();

  std::uint64_t newVersion() { return ++this->lastVersion_; }

  std::uint64_t lastVersion_ = 0;
  Occluders occluders_;
  std::vector<SurfaceRecord> records_;
  std::vector<std::uint32_t> vertexOfPoint_; ///< scratch memory for triangulate()
};

} // namespace gnomon
