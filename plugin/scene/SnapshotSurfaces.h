#pragma once

#include "plugin/ranks/Ranks.h"
#include "plugin/scene/WantedSurfaces.h"
#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon
{

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
  /// Make the snapshot hold these surfaces, in this order, and these volumes.
  /// @param ranks that share the frame, and the number of glyphs
  SnapshotChange update(std::vector<WantedSurface>& wanted,
    std::vector<std::shared_ptr<const Volume>> volumes, Ranks& ranks);

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

  int countInstances(std::vector<WantedSurface>& wanted, Ranks& ranks);
  bool updateFrame(const std::vector<WantedSurface>& wanted, Ranks& ranks);
  void read(WantedSurface& wanted, vtkMTimeType time);
  Outcome updateSurface(WantedSurface& wanted, bool reframed, SnapshotChange& change);
  bool transformAgain(const WantedSurface& wanted);
  bool moveInstances(std::size_t index, PlacedInstances& placed);
  Outcome overwrite(WantedSurface& wanted);
  void rebuild(std::vector<WantedSurface>& wanted);
  bool updateFlags(const std::vector<WantedSurface>& wanted);
  bool updateSheet(const WantedSurface& wanted, std::size_t index);
  void summarise();

  std::uint64_t newVersion() { return ++this->lastVersion_; }

  std::uint64_t lastVersion_ = 0;
  Occluders occluders_;
  std::uint64_t ranks_ = 0; ///< serial of the ranks whose box has set the frame
  std::vector<SurfaceRecord> records_;
  std::vector<std::uint32_t> vertexOfPoint_; ///< scratch memory for triangulate()
};

} // namespace gnomon
