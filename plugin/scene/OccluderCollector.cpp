#include "plugin/scene/OccluderCollector.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkProp.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <utility>

namespace gnomon
{

SnapshotChange OccluderCollector::collect(
  vtkRenderer* renderer, CollectOptions options, Ranks& ranks)
{
  const std::tuple collected(options.readsNormals, options.translucent, ranks.serial());
  const bool areSame =
    this->propMemory_.records.beginFrame(renderer->GetViewProps(), options.inputsHaveRun) &&
    this->collected_ == collected;
  this->lookup_.beginFrame();
  if (!ranks.isAny(!areSame))
  {
    return {};
  }
  this->collected_.reset(); // in case of an error
  DrawnProps drawn = findDrawnProps(renderer, this->propMemory_, options.translucent);
  this->lookup_.setDrawers(drawn.translucentReceivers, drawn.seenThrough);
  this->notes_ = std::move(drawn.notes);
  this->leftOut_ = std::move(drawn.leftOut);
  this->translucentReceivers_ = drawn.translucentReceivers.size();
  this->anyCatcher_ = drawn.anyCatcher;
  this->volumeReceivers_ = drawn.volumeReceivers;
  this->pointsWorld_ = drawn.pointsWorld;
  std::vector<WantedSurface> wanted = wantedSurfaces(drawn, this->surfaces_.records());
  for (WantedSurface& surface : wanted)
  {
    surface.block.normals = options.readsNormals ? surface.block.normals : nullptr;
  }
  const SnapshotChange change = this->surfaces_.update(wanted, std::move(drawn.volumes), ranks);
  const std::size_t numberings = this->propMemory_.records.numberings();
  if (std::exchange(this->numberings_, numberings) != numberings || change.any)
  {
    this->indexProps(wanted);
    this->noteOnBoxes_ = this->noteOnBoxes(wanted);
  }
  this->noteWhatIsTooLarge(wanted);
  this->collected_ = collected;
  return change;
}

/// Index the snapshot's surfaces by prop and matrix.
void OccluderCollector::indexProps(const std::vector<WantedSurface>& wanted)
{
  this->lookup_.clear(
    wanted.empty() ? 0 : static_cast<std::size_t>(wanted.back().prop->number) + 1);
  for (std::size_t i = 0; i < wanted.size();)
  {
    const DrawnProp& prop = *wanted[i].prop;
    std::vector<DrawnLookup::HeldSurface> held;
    for (; i < wanted.size() && wanted[i].prop == &prop; ++i)
    {
      const DrawnBlock& block = wanted[i].block;
      const std::size_t instances = solidOf(wanted[i].key.cells) != Solid::None
        ? this->occluders().surfaces[i].centredFromSource.size()
        : this->surfaces_.records()[i].modelFromInstance.size();
      held.push_back({ block.drawnAs ? block.drawnAs : block.data, wanted[i].key.cells,
        static_cast<std::uint32_t>(i), block.glyphPoints != nullptr,
        static_cast<std::uint32_t>(instances) });
    }
    if (!prop.translucent)
    {
      this->lookup_.add(prop.actor, prop.mapper, prop.worldFromModel, std::move(held),
        prop.isPlain ? std::optional(static_cast<std::size_t>(prop.number)) : std::nullopt);
    }
  }
}

void OccluderCollector::noteWhatIsTooLarge(const std::vector<WantedSurface>& wanted)
{
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    const SurfaceRecord& record = this->surfaces_.records()[i];
    if (record.tooManyTriangles)
    {
      this->notes_.push_back(std::string(wanted[i].prop->mapper->GetClassName()) + ": " +
        std::to_string(record.modelFromInstance.size()) + " glyphs have more than " +
        std::to_string(mostGlyphTriangles) + " triangles (they neither cast nor receive)");
    }
  }
  if (const std::size_t dropped = this->occluders().droppedNonFinite; dropped > 0)
  {
    this->notes_.push_back("missing data: " + std::to_string(dropped) +
      " triangles have a vertex that is not finite, or beyond 2^100 (they neither cast nor "
      "receive)");
  }
  if (!this->noteOnBoxes_.empty())
  {
    this->notes_.push_back(this->noteOnBoxes_);
  }
}

/// Return a note if a prop is so much larger than others that a fill value explains it. Empty if
/// none is.
std::string OccluderCollector::noteOnBoxes(const std::vector<WantedSurface>& wanted) const
{
  std::vector<std::pair<double, const vtkProp*>> radii;
  for (std::size_t i = 0; i < wanted.size();)
  {
    const DrawnProp& prop = *wanted[i].prop;
    Bounds box;
    for (; i < wanted.size() && wanted[i].prop == &prop; ++i)
    {
      box.add(this->occluders().surfaces[i].boundsCentred);
    }
    if (box.radius() > 0.0)
    {
      radii.emplace_back(box.radius(), prop.viewProp);
    }
  }
  std::sort(radii.begin(), radii.end());
  if (radii.empty() || !(radii.back().first > 0x1p20 * radii[(radii.size() - 1) / 2].first))
  {
    return {};
  }
  return std::string(radii.back().second->GetClassName()) +
    ": its box is more than 2^20 times as large as the median prop's, as a fill value makes it";
}

Bounds OccluderCollector::pointsCentred() const
{
  return this->pointsWorld_.empty()
    ? Bounds()
    : affinelyTransformed(this->pointsWorld_, this->occluders().frame.centredFrom(glm::dmat4(1.0)));
}

std::size_t OccluderCollector::bytes() const
{
  return this->surfaces_.bytes() + this->lookup_.bytes() + this->propMemory_.bytes();
}

HookedSurface OccluderCollector::drawn(vtkAbstractMapper* mapper, vtkProp* prop)
{
  return this->lookup_.find(
    mapper, prop, this->propMemory_.records.numberOf(prop), this->occluders());
}

} // namespace gnomon
