#pragma once

#include "plugin/scene/WantedSurfaces.h"

#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

/// Returns the box around a snapshot's surfaces and those that other processes hold of the scene,
/// from the box around the snapshot's. Empty: there are no others.
using UniteBounds = std::function<Bounds(const Bounds&)>;

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
  /// @param boundsOfAll returns the box that sets the centre, from that of these surfaces
  SnapshotChange update(std::vector<WantedSurface>& wanted, const UniteBounds& boundsOfAll);

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

  bool updateCentre(const std::vector<WantedSurface>& wanted, const UniteBounds& boundsOfAll);
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
