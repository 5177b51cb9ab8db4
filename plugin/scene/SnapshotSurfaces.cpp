#include "plugin/scene/SnapshotSurfaces.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/SmoothFacet.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace gnomon
{
namespace
{

/// Set the matrix of a surface's normals and the height of its facets.
void takeFacets(const SurfaceRecord& record, const SceneFrame& frame, Surface& surface)
{
  surface.centredFromNormals = glm::mat3(frame.centredFrom(record.worldFromModel));
  double scale = 0.0;
  if (record.facetHeight > 0.0f)
  {
    // Depends only on the surface's present place, like the rest of the snapshot.
    for (const glm::mat4& instance : record.modelFromInstance)
    {
      scale =
        std::max(scale, largestScale(glm::dmat3(record.worldFromModel * glm::dmat4(instance))));
    }
  }
  surface.facetHeight = static_cast<float>(scale * frame.unitsPerWorld() * record.facetHeight);
}

/// How many instances a rank has of a glyph, in all blocks of a mapper's input.
struct GlyphCount
{
  SharedName glyph;
  std::int64_t instances;
};

} // namespace

SnapshotChange SnapshotSurfaces::update(std::vector<WantedSurface>& wanted,
  std::vector<std::shared_ptr<const Volume>> volumes, Ranks& ranks)
{
  SnapshotChange change;
  bool otherList = wanted.size() != this->records_.size();
  bool moved = false;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    WantedSurface& surface = wanted[i];
    otherList = otherList || surface.old != i;
    const SurfaceRecord* record =
      surface.old != WantedSurface::none ? &this->records_[surface.old] : nullptr;
    const vtkMTimeType time = changeTime(*surface.prop, surface.block, surface.key.cells);
    const bool isMoved = !record || !isWhere(*record, *surface.prop, surface.block);
    if (!record || record->shapeTime != time || record->clipPlanes != surface.prop->clipPlanes ||
      !(record->coordinates.get() == coordinatesSource(*surface.prop, surface.block)) ||
      !(record->normals == normalsSource(*surface.prop, surface.block)) ||
      (isMoved && reachesBeyondWorld(*record, *surface.prop)))
    {
      this->read(surface, time);
      ++change.extracted;
    }
    moved = moved || isMoved;
  }

  change.extracted += this->countInstances(wanted, ranks);
  bool positionsChanged = false;
  bool trianglesChanged = otherList;
  const bool areOtherRanks = std::exchange(this->ranks_, ranks.serial()) != ranks.serial();
  change.any = otherList || moved || change.extracted > 0;
  bool reframed = false;
  if (ranks.isAny(change.any || areOtherRanks))
  {
    reframed = this->updateFrame(wanted, ranks);
    change.any = change.any || reframed;
  }
  if (change.any)
  {
    for (WantedSurface& surface : wanted)
    {
      const Outcome outcome = this->updateSurface(surface, reframed, change);
      positionsChanged = positionsChanged || outcome == Outcome::Moved;
      trianglesChanged = trianglesChanged || outcome == Outcome::OtherTriangles;
    }
    if (trianglesChanged)
    {
      this->rebuild(wanted);
    }
    this->vertexOfPoint_.clear();
    this->vertexOfPoint_.shrink_to_fit(); // as large as the largest input
  }

  const bool areOtherVolumes = this->occluders_.volumes != volumes;
  this->occluders_.volumes = std::move(volumes);
  const bool flagsChanged = this->updateFlags(wanted) || areOtherVolumes;
  if (trianglesChanged || flagsChanged)
  {
    this->occluders_.topologyVersion = this->newVersion();
  }
  if (trianglesChanged || flagsChanged || positionsChanged)
  {
    this->occluders_.positionsVersion = this->newVersion();
    this->summarise();
  }
  return change;
}

/// Count the instances that all processes have of each glyph. Read a glyph again if its number
/// makes another way to hold it cheaper.
/// @return how many were read again
int SnapshotSurfaces::countInstances(std::vector<WantedSurface>& wanted, Ranks& ranks)
{
  const auto recordOf = [&](const WantedSurface& surface) -> SurfaceRecord&
  { return surface.fresh ? surface.fresh->record : this->records_[surface.old]; };
  const auto countOf = [&](const WantedSurface& surface)
  {
    return GlyphCount{ sharedName(surface.prop->number, surface.key),
      static_cast<std::int64_t>(recordOf(surface).modelFromInstance.size()) };
  };
  std::vector<GlyphCount> own;
  for (const WantedSurface& surface : wanted)
  {
    if (surface.key.glyphPoints)
    {
      own.push_back(countOf(surface));
    }
  }
  Ranks::Gathered<GlyphCount> all;
  ranks.gather(own, all);
  std::map<SharedName, std::size_t> instancesOf;
  for (const GlyphCount& count : all.elements)
  {
    instancesOf[count.glyph] += static_cast<std::size_t>(count.instances);
  }
  int read = 0;
  for (WantedSurface& surface : wanted)
  {
    if (!surface.key.glyphPoints)
    {
      continue;
    }
    const std::size_t instances = instancesOf[countOf(surface).glyph];
    SurfaceRecord& record = recordOf(surface);
    const auto isCheaper = [&](std::size_t count)
    { return areInstancesCheaper(record.trianglesOfSource, count); };
    if (!surface.fresh && isCheaper(instances) != isCheaper(record.instancesOfAll))
    {
      this->read(surface, record.shapeTime);
      ++read;
    }
    recordOf(surface).instancesOfAll = instances;
  }
  return read;
}

/// Set the frame to that of the present box; true if it is another one.
bool SnapshotSurfaces::updateFrame(const std::vector<WantedSurface>& wanted, Ranks& ranks)
{
  Bounds boundsWorld;
  for (const WantedSurface& surface : wanted)
  {
    const SurfaceRecord& record =
      surface.fresh ? surface.fresh->record : this->records_[surface.old];
    const Bounds box = transformed(record.boundsModel, surface.prop->worldFromModel);
    boundsWorld.add(isWithin(box, largestOfWorld) ? box : Bounds());
  }
  const SceneFrame old =
    std::exchange(this->occluders_.frame, sceneFrameOf(ranks.united(boundsWorld)));
  return this->occluders_.frame != old;
}

void SnapshotSurfaces::read(WantedSurface& wanted, vtkMTimeType time)
{
  wanted.fresh = std::make_unique<FreshSurface>(
    readSurface(*wanted.prop, wanted.block, wanted.key.cells, this->vertexOfPoint_));
  wanted.fresh->record.key = wanted.key;
  wanted.fresh->record.shapeTime = time;
}

SnapshotSurfaces::Outcome SnapshotSurfaces::updateSurface(
  WantedSurface& wanted, bool reframed, SnapshotChange& change)
{
  bool maybeSame = wanted.old != WantedSurface::none; // the same triangles
  if (!wanted.fresh)
  {
    const SurfaceRecord& record = this->records_[wanted.old];
    if (!reframed && isWhere(record, *wanted.prop, wanted.block))
    {
      return Outcome::Same;
    }
    if (record.clipPlanes.empty()) // moving changes the triangles of a clipped surface
    {
      ++change.retransformed;
      if (this->transformAgain(wanted))
      {
        return Outcome::Moved;
      }
    }
    this->read(wanted, record.shapeTime);
    wanted.fresh->record.instancesOfAll = record.instancesOfAll;
    ++change.extracted;
    maybeSame = false;
  }
  placeSurface(*wanted.fresh, *wanted.prop, wanted.block, this->occluders_.frame);
  return maybeSame ? this->overwrite(wanted) : Outcome::OtherTriangles;
}

/// Compute a surface's positions at its new place. False if this changes which triangles are
/// dropped: then the surface must be read again.
bool SnapshotSurfaces::transformAgain(const WantedSurface& wanted)
{
  Surface& surface = this->occluders_.surfaces[wanted.old];
  SurfaceRecord& record = this->records_[wanted.old];
  if (record.keptAsInstances)
  {
    record.worldFromModel = wanted.prop->worldFromModel;
    record.radiusFromWorld = radiusFromWorld(wanted.block, record.key.cells);
    std::optional<PlacedInstances> placed =
      placeKeptInstances(record, wanted.block, this->occluders_.frame);
    return placed && this->moveInstances(wanted.old, *placed);
  }
  glm::vec3* all = this->occluders_.positionsCentred.data();
  glm::vec3* own = all + surface.firstVertex;
  record.worldFromModel = wanted.prop->worldFromModel;
  placeInstances(wanted.block, record, surface.vertexCount, this->occluders_.frame, own);

  const auto first = this->occluders_.triangles.begin() + surface.firstTriangle;
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
  takeFacets(record, this->occluders_.frame, surface);
  clearNonFinite(own, surface.vertexCount);
  surface.positionsVersion = this->newVersion();
  return true;
}

/// Store the new places of a surface's instances. False, without any change, if other instances are
/// left out or the front side changes. Then the surface counts as another one.
bool SnapshotSurfaces::moveInstances(std::size_t index, PlacedInstances& placed)
{
  Surface& surface = this->occluders_.surfaces[index];
  if (!placed.areMoved(surface))
  {
    return false;
  }
  recordPlaces(placed, this->occluders_.positionsCentred.data() + surface.firstVertex,
    surface.vertexCount, this->records_[index]);
  surface.centredFromSource = std::move(placed.centredFromSource);
  takeFacets(this->records_[index], this->occluders_.frame, surface);
  surface.positionsVersion = this->newVersion();
  return true;
}

/// Overwrite a surface in place by its fresh copy if the triangles are the same.
SnapshotSurfaces::Outcome SnapshotSurfaces::overwrite(WantedSurface& wanted)
{
  Surface& surface = this->occluders_.surfaces[wanted.old];
  FreshSurface& fresh = *wanted.fresh;
  const bool sameTriangles = surface.vertexCount == fresh.positionsCentred.size() &&
    surface.triangleOfDrawn == fresh.triangleOfDrawn &&
    surface.textureCoordinates == fresh.textureCoordinates &&
    surface.triangleCount == fresh.triangles.size() &&
    std::equal(fresh.triangles.begin(), fresh.triangles.end(),
      this->occluders_.triangles.begin() + surface.firstTriangle,
      [&surface](const glm::uvec3& own, const glm::uvec3& old)
      { return own + surface.firstVertex == old; });
  if (!sameTriangles)
  {
    return Outcome::OtherTriangles;
  }

  const auto positions = this->occluders_.positionsCentred.begin() + surface.firstVertex;
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
    surface.patches = std::make_shared<Patches>();
    surface.positionsVersion = this->newVersion();
  }
  const bool sameNormals = surface.pointNormals == fresh.pointNormals &&
    surface.centredFromNormals == glm::mat3(fresh.record.worldFromModel);
  surface.pointNormals = std::move(fresh.pointNormals);
  takeFacets(fresh.record, this->occluders_.frame, surface);
  if (!sameNormals)
  {
    surface.positionsVersion = this->newVersion();
    moved = true;
  }
  this->records_[wanted.old] = std::move(fresh.record);
  wanted.fresh.reset();
  return moved ? Outcome::Moved : Outcome::Same;
}

/// Rebuild the list from fresh surfaces and copies of the unchanged ones.
void SnapshotSurfaces::rebuild(std::vector<WantedSurface>& wanted)
{
  const Occluders& old = this->occluders_;
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
      entry.pointNormals = std::move(fresh.pointNormals);
      entry.centredFromSource = std::move(fresh.instances.centredFromSource);
      entry.mirrored = fresh.instances.mirrored;
      takeFacets(fresh.record, this->occluders_.frame, entry);
      entry.solid = solidOf(fresh.record.key.cells);
      entry.topologyVersion = this->newVersion();
      entry.positionsVersion = this->newVersion();
      records.push_back(std::move(fresh.record));
      surface.fresh.reset(); // frees memory early
    }
    else
    {
      entry = std::move(this->occluders_.surfaces[surface.old]);
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
  this->occluders_.positionsCentred = std::move(positions);
  this->occluders_.triangles = std::move(triangles);
  this->occluders_.surfaces = std::move(surfaces);
  this->records_ = std::move(records);
}

/// Store the props' flags, cut-outs and sheets; true if one changed.
bool SnapshotSurfaces::updateFlags(const std::vector<WantedSurface>& wanted)
{
  bool changed = false;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    Surface& surface = this->occluders_.surfaces[i];
    const DrawnProp& prop = *wanted[i].prop;
    const auto cutout = wanted[i].block.textureCoordinates ? prop.cutout : nullptr;
    changed = this->updateSheet(wanted[i], i) || changed;
    const bool blocks = prop.casts && !surface.sheet;
    changed = changed || surface.casts != blocks || surface.receives != prop.receives ||
      surface.oneSided != prop.oneSided || surface.isMoved != prop.isMoved ||
      surface.cutout != cutout;
    surface.casts = blocks;
    surface.receives = prop.receives;
    surface.oneSided = prop.oneSided;
    surface.isMoved = prop.isMoved;
    surface.cutout = cutout;
  }
  return changed;
}

/// Store a surface's sheet; true if it changed.
bool SnapshotSurfaces::updateSheet(const WantedSurface& wanted, std::size_t index)
{
  Surface& surface = this->occluders_.surfaces[index];
  SurfaceRecord& record = this->records_[index];
  const SheetSource source = sheetSource(*wanted.prop, wanted.block, surface);
  if (source == record.sheet.get())
  {
    return false;
  }
  record.sheet = source;
  const auto sheet =
    source == SheetSource() ? nullptr : readSheet(*wanted.prop, wanted.block, surface, record);
  if (sheet && surface.sheet && *sheet == *surface.sheet)
  {
    return false;
  }
  const bool changed = surface.sheet || sheet;
  surface.sheet = sheet;
  return changed;
}

/// Compute boxes and counts over all surfaces.
void SnapshotSurfaces::summarise()
{
  this->occluders_.castersCentred = Bounds();
  this->occluders_.allCentred = Bounds();
  this->occluders_.droppedNonFinite = 0;
  this->occluders_.droppedZeroArea = 0;
  for (std::size_t i = 0; i < this->records_.size(); ++i)
  {
    const SurfaceRecord& record = this->records_[i];
    Surface& surface = this->occluders_.surfaces[i];
    surface.boundsCentred = record.boundsCentred;
    this->occluders_.allCentred.add(surface.boundsCentred);
    if (surface.casts)
    {
      this->occluders_.castersCentred.add(surface.boundsCentred);
    }
    const std::size_t leftOut = record.leftOutNonFinite + record.leftOutVanished;
    const std::size_t times =
      surface.isInstanced() ? surface.centredFromSource.size() - leftOut : 1;
    for (const DroppedTriangle& dropped : record.dropped)
    {
      (dropped.defect == Defect::NonFinite ? this->occluders_.droppedNonFinite
                                           : this->occluders_.droppedZeroArea) += times;
    }
    this->occluders_.droppedNonFinite += record.leftOutNonFinite * surface.drawnCount();
    this->occluders_.droppedZeroArea += record.leftOutVanished * surface.drawnCount();
  }
}

std::size_t SnapshotSurfaces::bytes() const
{
  std::size_t bytes = bytesOf(this->occluders_.positionsCentred) +
    bytesOf(this->occluders_.triangles) + bytesOf(this->occluders_.surfaces) +
    bytesOf(this->records_) + bytesOf(this->vertexOfPoint_);
  for (const Surface& surface : this->occluders_.surfaces)
  {
    bytes += bytesOf(surface.triangleOfDrawn) + bytesOf(surface.textureCoordinates) +
      bytesOf(surface.pointNormals) + surface.patches->bytes() + bytesOf(surface.centredFromSource);
  }
  for (const SurfaceRecord& record : this->records_)
  {
    bytes += bytesOf(record.clipPlanes) + bytesOf(record.pointOfVertex) +
      bytesOf(record.modelFromInstance) + bytesOf(record.dropped);
  }
  return bytes;
}

} // namespace gnomon
