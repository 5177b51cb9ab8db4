#include "plugin/scene/OccluderCollector.h"

#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/PlainProps.h"
#include "plugin/scene/SurfaceRecord.h"
#include "plugin/scene/TextureCutouts.h"

#include "shadowtech/base/Bytes.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

namespace gnomon
{
namespace
{

/// One surface that the snapshot shall hold after this frame.
struct WantedSurface
{
  SurfaceKey key;
  DrawnBlock block;
  const DrawnProp* prop;
  std::size_t old = none;              ///< its number in the snapshot so far
  std::unique_ptr<FreshSurface> fresh; ///< set while it waits to be put into the snapshot

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
};

} // namespace

//------------------------------------------------------------------------------
struct OccluderCollector::Impl
{
public:
  Change collect(vtkRenderer* renderer);
  std::size_t bytes() const;

  Occluders occluders;
  DrawnLookup lookup;
  std::size_t translucentReceivers = 0;
  std::vector<std::string> notes;

private:
  /// What became of a surface since the last frame.
  enum class Outcome
  {
    Same,
    Moved,         ///< the same triangles at other positions, already written to the snapshot
    OtherTriangles ///< waits in WantedSurface::fresh
  };

  std::vector<WantedSurface> wantedSurfaces(const DrawnProps& drawn) const;
  bool updateCentre(const std::vector<WantedSurface>& wanted);
  void read(WantedSurface& wanted, vtkMTimeType time);
  Outcome updateSurface(WantedSurface& wanted, bool recentred, Change& change);
  bool transformAgain(const WantedSurface& wanted);
  bool moveInstances(std::size_t index, PlacedInstances& placed);
  Outcome overwrite(WantedSurface& wanted);
  void rebuild(std::vector<WantedSurface>& wanted);
  void noteWhatIsTooLarge(const std::vector<WantedSurface>& wanted);
  bool updateFlags(const std::vector<WantedSurface>& wanted);
  void summarise();
  void indexProps(const std::vector<WantedSurface>& wanted);

  std::uint64_t newVersion() { return ++this->lastVersion_; }

  std::uint64_t lastVersion_ = 0;
  TextureCutouts cutouts_;
  PlainProps plainProps_;
  std::vector<SurfaceRecord> records_;       ///< one for each of occluders.surfaces
  std::vector<std::uint32_t> vertexOfPoint_; ///< scratch memory for triangulate()
};

//------------------------------------------------------------------------------
OccluderCollector::Change OccluderCollector::Impl::collect(vtkRenderer* renderer)
{
  DrawnProps drawn = findDrawnProps(renderer, this->cutouts_, this->plainProps_);
  this->lookup.beginFrame(drawn.translucentReceivers);
  this->notes = std::move(drawn.notes);
  this->translucentReceivers = drawn.translucentReceivers.size();
  std::vector<WantedSurface> wanted = this->wantedSurfaces(drawn);

  Change change;
  bool otherList = wanted.size() != this->records_.size();
  bool moved = false;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    WantedSurface& surface = wanted[i];
    otherList = otherList || surface.old != i;
    const SurfaceRecord* record =
      surface.old != WantedSurface::none ? &this->records_[surface.old] : nullptr;
    const vtkMTimeType time = changeTime(*surface.prop, surface.block, surface.key.cells);
    if (!record || record->shapeTime != time || record->clipPlanes != surface.prop->clipPlanes ||
      !(record->coordinates == coordinatesSource(*surface.prop, surface.block)))
    {
      this->read(surface, time);
      ++change.extracted;
    }
    moved = moved || !record || record->worldFromModel != surface.prop->worldFromModel;
  }

  bool positionsChanged = false;
  bool trianglesChanged = otherList;
  if (otherList || moved || change.extracted > 0)
  {
    const bool recentred = this->updateCentre(wanted);
    for (WantedSurface& surface : wanted)
    {
      const Outcome outcome = this->updateSurface(surface, recentred, change);
      positionsChanged = positionsChanged || outcome == Outcome::Moved;
      trianglesChanged = trianglesChanged || outcome == Outcome::OtherTriangles;
    }
    if (trianglesChanged)
    {
      this->rebuild(wanted);
    }
    this->indexProps(wanted);
    this->vertexOfPoint_.clear();
    this->vertexOfPoint_.shrink_to_fit(); // as large as the largest input
  }

  this->noteWhatIsTooLarge(wanted);
  const bool flagsChanged = this->updateFlags(wanted);
  if (trianglesChanged || flagsChanged)
  {
    this->occluders.topologyVersion = this->newVersion();
  }
  if (trianglesChanged || flagsChanged || positionsChanged)
  {
    this->occluders.positionsVersion = this->newVersion();
    this->summarise();
  }
  return change;
}

//------------------------------------------------------------------------------
std::vector<WantedSurface> OccluderCollector::Impl::wantedSurfaces(const DrawnProps& drawn) const
{
  std::vector<WantedSurface> wanted;
  wanted.reserve(std::max(drawn.blocks.size(), this->records_.size()));
  for (const DrawnProp& prop : drawn.props)
  {
    for (std::size_t block = 0; block < prop.blockCount; ++block)
    {
      const DrawnBlock& drawnBlock = drawn.blocks[prop.firstBlock + block];
      for (const SurfaceCells cells : { SurfaceCells::Polygons, SurfaceCells::Strips })
      {
        if (cellCount(drawnBlock.data, cells) > 0)
        {
          wanted.push_back(
            { { prop.viewProp, prop.path, prop.actor, prop.translucent, drawnBlock.data,
                drawnBlock.glyphPoints, drawnBlock.glyphSource, cells },
              drawnBlock, &prop, WantedSurface::none, nullptr });
        }
      }
    }
  }

  // Most frames list the same surfaces again; only if not, look up what each one was.
  std::unordered_map<SurfaceKey, std::size_t, SurfaceKeyHash> oldOfKey;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    if (oldOfKey.empty() && i < this->records_.size() && this->records_[i].key == wanted[i].key)
    {
      wanted[i].old = i;
      continue;
    }
    if (oldOfKey.empty())
    {
      for (std::size_t old = i; old < this->records_.size(); ++old)
      {
        oldOfKey.emplace(this->records_[old].key, old);
      }
    }
    const auto found = oldOfKey.find(wanted[i].key);
    if (found != oldOfKey.end())
    {
      wanted[i].old = found->second;
    }
  }
  return wanted;
}

//------------------------------------------------------------------------------
/// Sets the centre to that of the present box; true if it moved.
bool OccluderCollector::Impl::updateCentre(const std::vector<WantedSurface>& wanted)
{
  Bounds boundsWorld;
  for (const WantedSurface& surface : wanted)
  {
    const SurfaceRecord& record =
      surface.fresh ? surface.fresh->record : this->records_[surface.old];
    boundsWorld.add(transformed(record.boundsModel, surface.prop->worldFromModel));
  }
  const glm::dvec3 old = std::exchange(this->occluders.centreWorld, snapshotCentre(boundsWorld));
  return this->occluders.centreWorld != old;
}

//------------------------------------------------------------------------------
void OccluderCollector::Impl::read(WantedSurface& wanted, vtkMTimeType time)
{
  wanted.fresh = std::make_unique<FreshSurface>(
    readSurface(*wanted.prop, wanted.block, wanted.key.cells, this->vertexOfPoint_));
  wanted.fresh->record.key = wanted.key;
  wanted.fresh->record.shapeTime = time;
}

//------------------------------------------------------------------------------
OccluderCollector::Impl::Outcome OccluderCollector::Impl::updateSurface(
  WantedSurface& wanted, bool recentred, Change& change)
{
  bool maybeSame = wanted.old != WantedSurface::none; // the same triangles
  if (!wanted.fresh)
  {
    const SurfaceRecord& record = this->records_[wanted.old];
    if (!recentred && record.worldFromModel == wanted.prop->worldFromModel)
    {
      return Outcome::Same;
    }
    if (record.clipPlanes.empty()) // what is cut at planes has other triangles once it moves
    {
      ++change.retransformed;
      if (this->transformAgain(wanted))
      {
        return Outcome::Moved;
      }
    }
    this->read(wanted, record.shapeTime);
    ++change.extracted;
    maybeSame = false;
  }
  placeSurface(*wanted.fresh, *wanted.prop, wanted.block, this->occluders.centreWorld);
  return maybeSame ? this->overwrite(wanted) : Outcome::OtherTriangles;
}

//------------------------------------------------------------------------------
/// Computes a surface's positions again where they are. False if another set of triangles would
/// have to be dropped than before: then the surface must be read again.
bool OccluderCollector::Impl::transformAgain(const WantedSurface& wanted)
{
  Surface& surface = this->occluders.surfaces[wanted.old];
  SurfaceRecord& record = this->records_[wanted.old];
  if (record.keptAsInstances)
  {
    record.worldFromModel = wanted.prop->worldFromModel;
    std::optional<PlacedInstances> placed = placeKeptInstances(record, this->occluders.centreWorld);
    return placed && this->moveInstances(wanted.old, *placed);
  }
  glm::vec3* all = this->occluders.positionsCentred.data();
  glm::vec3* own = all + surface.firstVertex;
  record.worldFromModel = wanted.prop->worldFromModel;
  placeInstances(wanted.block, record, surface.vertexCount, this->occluders.centreWorld, own);

  const auto first = this->occluders.triangles.begin() + surface.firstTriangle;
  const auto last = first + surface.triangleCount;
  const bool keptStay = std::all_of(first, last,
    [all](const glm::uvec3& triangle) { return defectOf(triangle, all) == Defect::None; });
  const bool droppedStay = std::all_of(record.dropped.begin(), record.dropped.end(),
    [own](const DroppedTriangle& dropped)
    { return defectOf(dropped.vertices, own) == dropped.defect; });
  if (!keptStay || !droppedStay)
  {
    return false;
  }
  record.boundsCentred = boundsOf(first, last, all);
  clearNonFinite(own, surface.vertexCount);
  surface.positionsVersion = this->newVersion();
  return true;
}

//------------------------------------------------------------------------------
/// Takes over where a surface's instances are now. False, and nothing is taken, if others are left
/// out than before, or the other side is the front: then the surface counts as another.
bool OccluderCollector::Impl::moveInstances(std::size_t index, PlacedInstances& placed)
{
  Surface& surface = this->occluders.surfaces[index];
  if (!placed.areMoved(surface))
  {
    return false;
  }
  recordPlaces(placed, this->occluders.positionsCentred.data() + surface.firstVertex,
    surface.vertexCount, this->records_[index]);
  surface.centredFromSource = std::move(placed.centredFromSource);
  surface.positionsVersion = this->newVersion();
  return true;
}

//------------------------------------------------------------------------------
/// Writes a fresh surface over its old self if the triangles are the same.
OccluderCollector::Impl::Outcome OccluderCollector::Impl::overwrite(WantedSurface& wanted)
{
  Surface& surface = this->occluders.surfaces[wanted.old];
  FreshSurface& fresh = *wanted.fresh;
  const bool sameTriangles = surface.vertexCount == fresh.positionsCentred.size() &&
    surface.triangleOfDrawn == fresh.triangleOfDrawn &&
    surface.textureCoordinates == fresh.textureCoordinates &&
    surface.triangleCount == fresh.triangles.size() &&
    std::equal(fresh.triangles.begin(), fresh.triangles.end(),
      this->occluders.triangles.begin() + surface.firstTriangle,
      [&surface](const glm::uvec3& own, const glm::uvec3& old)
      { return own + surface.firstVertex == old; });
  if (!sameTriangles)
  {
    return Outcome::OtherTriangles;
  }

  const auto positions = this->occluders.positionsCentred.begin() + surface.firstVertex;
  bool moved = !std::equal(fresh.positionsCentred.begin(), fresh.positionsCentred.end(), positions);
  if (surface.isInstanced() || fresh.record.keptAsInstances)
  {
    const bool sameSource = !moved && surface.isInstanced() == fresh.record.keptAsInstances;
    moved = surface.centredFromSource != fresh.instances.centredFromSource;
    if (!sameSource || (moved && !this->moveInstances(wanted.old, fresh.instances)))
    {
      return Outcome::OtherTriangles;
    }
  }
  else if (moved)
  {
    std::copy(fresh.positionsCentred.begin(), fresh.positionsCentred.end(), positions);
    surface.positionsVersion = this->newVersion();
  }
  this->records_[wanted.old] = std::move(fresh.record);
  wanted.fresh.reset();
  return moved ? Outcome::Moved : Outcome::Same;
}

//------------------------------------------------------------------------------
/// Lists the surfaces anew: fresh ones as they were read, the others copied.
void OccluderCollector::Impl::rebuild(std::vector<WantedSurface>& wanted)
{
  const Occluders& old = this->occluders;
  std::size_t vertexCount = 0;
  std::size_t triangleCount = 0;
  for (const WantedSurface& surface : wanted)
  {
    vertexCount += surface.fresh ? surface.fresh->positionsCentred.size()
                                 : old.surfaces[surface.old].vertexCount;
    triangleCount +=
      surface.fresh ? surface.fresh->triangles.size() : old.surfaces[surface.old].triangleCount;
  }

  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<Surface> surfaces;
  std::vector<SurfaceRecord> records;
  positions.reserve(vertexCount + 1); // the slack that Occluders promises
  triangles.reserve(triangleCount);
  surfaces.reserve(wanted.size());
  records.reserve(wanted.size());
  for (WantedSurface& surface : wanted)
  {
    Surface entry;
    const auto firstVertex = static_cast<std::uint32_t>(positions.size());
    const auto firstTriangle = static_cast<std::uint32_t>(triangles.size());
    if (surface.fresh)
    {
      FreshSurface& fresh = *surface.fresh;
      positions.insert(
        positions.end(), fresh.positionsCentred.begin(), fresh.positionsCentred.end());
      for (const glm::uvec3& triangle : fresh.triangles)
      {
        triangles.push_back(triangle + firstVertex);
      }
      entry.vertexCount = static_cast<std::uint32_t>(fresh.positionsCentred.size());
      entry.triangleCount = static_cast<std::uint32_t>(fresh.triangles.size());
      entry.triangleOfDrawn = std::move(fresh.triangleOfDrawn);
      entry.textureCoordinates = std::move(fresh.textureCoordinates);
      entry.centredFromSource = std::move(fresh.instances.centredFromSource);
      entry.mirrored = fresh.instances.mirrored;
      entry.topologyVersion = this->newVersion();
      entry.positionsVersion = this->newVersion();
      records.push_back(std::move(fresh.record));
      surface.fresh.reset(); // its memory is not needed twice
    }
    else
    {
      entry = std::move(this->occluders.surfaces[surface.old]);
      const auto oldPositions = old.positionsCentred.begin() + entry.firstVertex;
      positions.insert(positions.end(), oldPositions, oldPositions + entry.vertexCount);
      const std::uint32_t shift = firstVertex - entry.firstVertex; // modulo 2^32
      for (std::uint32_t i = 0; i < entry.triangleCount; ++i)
      {
        triangles.push_back(old.triangles[entry.firstTriangle + i] + shift);
      }
      records.push_back(std::move(this->records_[surface.old]));
    }
    entry.firstVertex = firstVertex;
    entry.firstTriangle = firstTriangle;
    surfaces.push_back(std::move(entry));
  }
  this->occluders.positionsCentred = std::move(positions);
  this->occluders.triangles = std::move(triangles);
  this->occluders.surfaces = std::move(surfaces);
  this->records_ = std::move(records);
}

//------------------------------------------------------------------------------
void OccluderCollector::Impl::noteWhatIsTooLarge(const std::vector<WantedSurface>& wanted)
{
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    if (this->records_[i].tooManyTriangles)
    {
      this->notes.push_back(std::string(wanted[i].prop->mapper->GetClassName()) + ": " +
        std::to_string(this->records_[i].modelFromInstance.size()) + " glyphs have more than " +
        std::to_string(mostGlyphTriangles) + " triangles (they neither cast nor receive)");
    }
  }
}

//------------------------------------------------------------------------------
/// Takes over the props' flags and what their textures cut out; true if one changed.
bool OccluderCollector::Impl::updateFlags(const std::vector<WantedSurface>& wanted)
{
  bool changed = false;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    Surface& surface = this->occluders.surfaces[i];
    const DrawnProp& prop = *wanted[i].prop;
    const auto cutout = wanted[i].block.textureCoordinates ? prop.cutout : nullptr;
    changed = changed || surface.casts != prop.casts || surface.receives != prop.receives ||
      surface.oneSided != prop.oneSided || surface.cutout != cutout;
    surface.casts = prop.casts;
    surface.receives = prop.receives;
    surface.oneSided = prop.oneSided;
    surface.cutout = cutout;
  }
  return changed;
}

//------------------------------------------------------------------------------
/// Boxes and counts over all surfaces.
void OccluderCollector::Impl::summarise()
{
  this->occluders.castersCentred = Bounds();
  this->occluders.allCentred = Bounds();
  this->occluders.droppedNonFinite = 0;
  this->occluders.droppedZeroArea = 0;
  for (std::size_t i = 0; i < this->records_.size(); ++i)
  {
    const SurfaceRecord& record = this->records_[i];
    this->occluders.allCentred.add(record.boundsCentred);
    if (this->occluders.surfaces[i].casts)
    {
      this->occluders.castersCentred.add(record.boundsCentred);
    }
    const Surface& surface = this->occluders.surfaces[i];
    const std::size_t leftOut = record.leftOutNonFinite + record.leftOutVanished;
    const std::size_t times =
      surface.isInstanced() ? surface.centredFromSource.size() - leftOut : 1;
    for (const DroppedTriangle& dropped : record.dropped)
    {
      (dropped.defect == Defect::NonFinite ? this->occluders.droppedNonFinite
                                           : this->occluders.droppedZeroArea) += times;
    }
    this->occluders.droppedNonFinite += record.leftOutNonFinite * surface.drawnCount();
    this->occluders.droppedZeroArea += record.leftOutVanished * surface.drawnCount();
  }
}

//------------------------------------------------------------------------------
std::size_t OccluderCollector::Impl::bytes() const
{
  std::size_t bytes = bytesOf(this->occluders.positionsCentred) +
    bytesOf(this->occluders.triangles) + bytesOf(this->occluders.surfaces) +
    bytesOf(this->records_) + bytesOf(this->vertexOfPoint_) + this->lookup.bytes() +
    this->cutouts_.bytes() + this->plainProps_.bytes();
  for (const Surface& surface : this->occluders.surfaces)
  {
    bytes += bytesOf(surface.triangleOfDrawn) + bytesOf(surface.textureCoordinates) +
      bytesOf(surface.centredFromSource);
  }
  for (const SurfaceRecord& record : this->records_)
  {
    bytes += bytesOf(record.clipPlanes) + bytesOf(record.pointOfVertex) +
      bytesOf(record.modelFromInstance) + bytesOf(record.dropped);
  }
  return bytes;
}

//------------------------------------------------------------------------------
/// Makes the snapshot's surfaces findable by prop and matrix.
void OccluderCollector::Impl::indexProps(const std::vector<WantedSurface>& wanted)
{
  this->lookup.clear();
  for (std::size_t i = 0; i < wanted.size();)
  {
    const DrawnProp& prop = *wanted[i].prop;
    std::vector<DrawnLookup::HeldSurface> held;
    for (; i < wanted.size() && wanted[i].prop == &prop; ++i)
    {
      held.push_back({ wanted[i].block.data, wanted[i].key.cells, static_cast<std::uint32_t>(i),
        wanted[i].block.glyphPoints != nullptr,
        static_cast<std::uint32_t>(this->records_[i].modelFromInstance.size()) });
    }
    if (!prop.translucent)
    {
      this->lookup.add(prop.actor, prop.mapper, prop.worldFromModel, std::move(held));
    }
  }
}

//------------------------------------------------------------------------------
OccluderCollector::OccluderCollector()
  : impl_(std::make_unique<Impl>())
{
}

//------------------------------------------------------------------------------
OccluderCollector::~OccluderCollector() = default;

//------------------------------------------------------------------------------
OccluderCollector::Change OccluderCollector::collect(vtkRenderer* renderer)
{
  return this->impl_->collect(renderer);
}

//------------------------------------------------------------------------------
const Occluders& OccluderCollector::occluders() const
{
  return this->impl_->occluders;
}

//------------------------------------------------------------------------------
const std::vector<std::string>& OccluderCollector::notes() const
{
  return this->impl_->notes;
}

//------------------------------------------------------------------------------
std::size_t OccluderCollector::translucentReceivers() const
{
  return this->impl_->translucentReceivers;
}

//------------------------------------------------------------------------------
std::size_t OccluderCollector::bytes() const
{
  return this->impl_->bytes();
}

//------------------------------------------------------------------------------
Drawn OccluderCollector::drawn(vtkAbstractMapper* mapper, vtkProp* prop)
{
  return this->impl_->lookup.find(mapper, prop, this->impl_->occluders);
}

//------------------------------------------------------------------------------
const std::vector<DrawnSurface>& OccluderCollector::drawnSurfaces() const
{
  return this->impl_->lookup.drawnSurfaces();
}

} // namespace gnomon
