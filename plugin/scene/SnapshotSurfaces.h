#pragma once

#include "plugin/scene/WantedSurfaces.h"

#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// What one update of the snapshot did.
struct SnapshotChange
{
  int extracted = 0;     ///< surfaces whose mapper's input was read
  int retransformed = 0; ///< surfaces whose centred positions were computed again
  bool any = false;      ///< whether any surface is new, gone, changed or moved
};

/// The surfaces in the snapshot, with a record of each. An update leaves unchanged surfaces alone,
/// transforms moved ones in place, and rebuilds the list only if triangles changed.
class SnapshotSurfaces
{
public:
  /// Makes the snapshot hold these surfaces, in this order.
  SnapshotChange update(std::vector<WantedSurface>& wanted);

  const Occluders& occluders() const { return this->occluders_; }
  /// One for each of the snapshot's surfaces.
  const std::vector<SurfaceRecord>& records() const { return this->records_; }
  std::size_t bytes() const;

private:
  /// What became of a surface since the last frame.
  enum class Outcome
  {
    Same,
    Moved,         ///< the same triangles at other positions, already written to the snapshot
    OtherTriangles ///< waits in WantedSurface::fresh
  };

  bool updateCentre(const std::vector<WantedSurface>& wanted);
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
