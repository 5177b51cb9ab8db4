#include "plugin/scene/DrawnLookup.h"

#include "lights/Hash.h"
#include "plugin/scene/ActorInternals.h"
#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/MapperInternals.h"
#include "plugin/scene/MapperKind.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace gnomon
{
namespace
{

/// Return the identity of a surface among those of a prop. A shallow copy of its data has the same.
auto identityOf(const DrawnLookup::HeldSurface& surface)
{
  return std::pair(surface.cells, identityOf(surface.data, surface.cells));
}

bool isBefore(const DrawnLookup::HeldSurface& a, const DrawnLookup::HeldSurface& b)
{
  return identityOf(a) < identityOf(b);
}

/// True if a mapper draws these cells of a prop as a surface.
bool drawsSurface(vtkAbstractMapper* mapper, vtkProp* prop, SurfaceCells cells)
{
  auto* actor = vtkActor::SafeDownCast(prop);
  if (!actor)
  {
    return false;
  }
  vtkProperty* property = actor->GetProperty();
  return cells == SurfaceCells::PointSpheres ? property->GetRenderPointsAsSpheres()
    : cells == SurfaceCells::LineTubes       ? property->GetRenderLinesAsTubes()
                                       : drawnAsSurface(property, vtkMapper::SafeDownCast(mapper));
}

} // namespace

int cornersOfPrimitives(vtkAbstractMapper* mapper, vtkProp* prop)
{
  const std::optional<SurfaceCells> cells = cellsAboutToBeDrawn(mapper);
  if (!cells || !drawsSurface(mapper, prop, *cells))
  {
    return 0;
  }
  return *cells == SurfaceCells::PointSpheres ? 1 : *cells == SurfaceCells::LineTubes ? 2 : 3;
}

std::size_t DrawnLookup::PlaceHash::operator()(const Place& place) const
{
  std::size_t seed = 0;
  hashCombine(seed, place.drawer);
  // The position tells a drawer's places apart; std::hash is equal for 0.0 and -0.0, as they are.
  for (int row = 0; row < 3; ++row)
  {
    hashCombine(seed, place.worldFromModel[3][row]);
  }
  return seed;
}

std::size_t DrawnLookup::QuestionHash::operator()(const Question& question) const
{
  std::size_t seed = 0;
  hashCombine(seed, question.held);
  hashCombine(seed, question.mapper);
  hashCombine(seed, static_cast<int>(question.cells));
  return seed;
}

void DrawnLookup::clear(std::size_t props)
{
  this->held_.clear();
  this->heldAt_.clear();
  this->plain_.assign(props, {});
  this->answers_.clear();
  this->taken_.clear();
}

void DrawnLookup::add(const vtkProp* actor, const vtkMapper* mapper,
  const glm::dmat4& worldFromModel, std::vector<HeldSurface> held,
  std::optional<std::size_t> plainNumber)
{
  const std::size_t number = this->held_.size();
  const bool isGlyph = held.front().isGlyph;
  if (!isGlyph)
  {
    std::sort(held.begin(), held.end(), isBefore);
  }
  if (plainNumber && held.size() == 1)
  {
    PlainDrawing& plain = this->plain_[*plainNumber];
    plain.mapper = mapper;
    plain.held = number;
    const glm::dmat4 columns = glm::transpose(worldFromModel);
    std::copy_n(glm::value_ptr(columns), 16, plain.worldFromModel.begin());
  }
  else
  {
    this->heldAt_.emplace(Place{ actor, worldFromModel }, number);
    if (isGlyph || !isPlainActor(actor))
    {
      // It may be drawn by another actor, which has the mapper.
      this->heldAt_.emplace(Place{ mapper, worldFromModel }, number);
    }
  }
  this->held_.push_back(std::move(held));
}

void DrawnLookup::beginFrame()
{
  ++this->frame_;
  this->answers_.clear();
  this->taken_.clear();
  this->drawnSurfaces_.clear();
}

void DrawnLookup::setDrawers(
  const std::vector<const void*>& translucentReceivers, const std::vector<const void*>& seenThrough)
{
  this->translucentReceivers_ = { translucentReceivers.begin(), translucentReceivers.end() };
  this->seenThrough_ = { seenThrough.begin(), seenThrough.end() };
}

/// True if a prop or its mapper is among drawers, as DrawnProps lists them.
bool DrawnLookup::isAmong(vtkProp* prop, const std::unordered_set<const void*>& drawers)
{
  auto* const actor = drawers.empty() ? nullptr : vtkActor::SafeDownCast(prop);
  return actor && (drawers.count(prop) > 0 || drawers.count(actor->GetMapper()) > 0);
}

std::size_t DrawnLookup::bytes() const
{
  return bytesOf(this->held_) + bytesOfTable(this->heldAt_) + bytesOf(this->plain_) +
    bytesOfTable(this->answers_) + bytesOfTable(this->translucentReceivers_) +
    bytesOfTable(this->seenThrough_) + bytesOfTable(this->taken_) + bytesOf(this->drawnSurfaces_) +
    bytesOfAll(this->held_, bytesOf<HeldSurface>) +
    bytesOfAll(
      this->drawnSurfaces_, [](const DrawnSurface& drawn) { return bytesOf(drawn.blocks); });
}

const DrawnLookup::HeldSurfaces* DrawnLookup::heldBy(vtkProp* prop) const
{
  vtkMatrix4x4* matrix = prop->GetMatrix();
  auto* actor = vtkActor::SafeDownCast(prop);
  if (!matrix || !actor)
  {
    return nullptr;
  }
  const glm::dmat4 worldFromModel = toGlm(matrix);
  auto found = this->heldAt_.find({ actor, worldFromModel });
  if (found == this->heldAt_.end())
  {
    // A glyph mapper draws blocks of a composite data set with a temporary actor, ParaView's actors
    // their levels of detail with an inner one.
    found = this->heldAt_.find({ actor->GetMapper(), worldFromModel });
  }
  return found != this->heldAt_.end() ? &this->held_[found->second] : nullptr;
}

/// Return the surface that is made of these cells, or null. Helpers and parts of mappers draw
/// shallow copies of its data. VTK draws glyphs that share the cells in the order in which they are
/// held.
const DrawnLookup::HeldSurface* DrawnLookup::match(
  const HeldSurfaces& held, vtkPolyData* data, SurfaceCells cells)
{
  const HeldSurface wanted{ data, cells };
  if (!held.front().isGlyph)
  {
    const auto place = std::lower_bound(held.begin(), held.end(), wanted, isBefore);
    return place == held.end() || isBefore(wanted, *place) ? nullptr : &*place;
  }
  const auto place = std::find_if(held.begin(), held.end(),
    [&](const HeldSurface& surface)
    {
      return surface.instances > 0 && identityOf(surface) == identityOf(wanted) &&
        this->taken_.count(&surface) == 0;
    });
  if (place == held.end())
  {
    return nullptr;
  }
  this->taken_.insert(&*place);
  return &*place;
}

/// Return a plain prop's drawing, if the prop is in its place; else null.
DrawnLookup::PlainDrawing* DrawnLookup::plainHere(vtkProp* prop, std::optional<std::size_t> number)
{
  if (!number || *number >= this->plain_.size() || !this->plain_[*number].mapper)
  {
    return nullptr;
  }
  PlainDrawing& plain = this->plain_[*number];
  // An assembly that has the actor, too, moves it while it draws.
  const bool isHere = std::equal(
    plain.worldFromModel.begin(), plain.worldFromModel.end(), prop->GetMatrix()->GetData());
  return isHere ? &plain : nullptr;
}

/// Return the facts about a plain prop, which is one of the frame's drawn surfaces.
HookedSurface DrawnLookup::take(PlainDrawing& plain, const Occluders& occluders)
{
  if (plain.frame != this->frame_)
  {
    plain.frame = this->frame_;
    plain.index = static_cast<int>(this->drawnSurfaces_.size());
    this->drawnSurfaces_.push_back({ { plain.block } });
  }
  const Surface& surface = occluders.surfaces[plain.block.surface];
  return { plain.index, surface.receives, false, surface.facetHeight, 0 };
}

/// Match the blocks that a mapper is about to draw with the surfaces that are held.
/// @return the blocks that are found, and the facts about them but the index
std::pair<DrawnSurface, HookedSurface> DrawnLookup::matchBlocks(const HeldSurfaces& held,
  vtkAbstractMapper* mapper, SurfaceCells cells, const Occluders& occluders)
{
  DrawnSurface drawn;
  HookedSurface hooked;
  // An unexpected level of detail receives, too. Drawing the receivers changes the times by which
  // VTK chooses levels, so VTK may shade another level than it drew there.
  hooked.receives = occluders.surfaces[held.front().surface].receives;
  for (const DrawCall& call : drawCalls(mapper, cells))
  {
    const HeldSurface* found = this->match(held, call.data, cells);
    if (!found)
    {
      continue; // a hidden or translucent block, or one without such cells
    }
    const Surface& surface = occluders.surfaces[found->surface];
    const std::uint32_t drawnCount =
      surface.drawnCount() * (surface.isInstanced() ? found->instances : 1);
    drawn.blocks.push_back({ call.firstPrimitive, drawnCount, found->surface });
    hooked.facetHeight = std::max(hooked.facetHeight, surface.facetHeight);
    hooked.primitivesPerInstance = found->isGlyph ? drawnCount / found->instances : 0;
  }
  return { std::move(drawn), hooked };
}

HookedSurface DrawnLookup::find(vtkAbstractMapper* mapper, vtkProp* prop,
  std::optional<std::size_t> number, const Occluders& occluders)
{
  const std::optional<SurfaceCells> cells = cellsAboutToBeDrawn(mapper);
  if (!cells || !drawsSurface(mapper, prop, *cells))
  {
    return {};
  }
  if (prop->IsRenderingTranslucentPolygonalGeometry())
  {
    HookedSurface drawn;
    drawn.receives = isAmong(prop, this->translucentReceivers_);
    drawn.translucent = true;
    return drawn;
  }
  PlainDrawing* const here = this->plainHere(prop, number);
  PlainDrawing* const plain =
    here && here->mapper == mapper && *cells == SurfaceCells::Polygons ? here : nullptr;
  if (plain && plain->block.primitiveCount > 0)
  {
    return this->take(*plain, occluders);
  }
  const HeldSurfaces* held = here ? &this->held_[here->held] : this->heldBy(prop);
  if (!held)
  {
    return {};
  }
  if (plain)
  {
    const auto [drawn, hooked] = this->matchBlocks(*held, mapper, *cells, occluders);
    if (drawn.blocks.empty())
    {
      return hooked;
    }
    plain->block = drawn.blocks.front();
    return this->take(*plain, occluders);
  }
  const auto [answer, isNew] =
    this->answers_.emplace(Question{ held, mapper, *cells }, HookedSurface());
  if (isNew)
  {
    auto [drawn, hooked] = this->matchBlocks(*held, mapper, *cells, occluders);
    if (!drawn.blocks.empty())
    {
      hooked.index = static_cast<int>(this->drawnSurfaces_.size());
      this->drawnSurfaces_.push_back(std::move(drawn));
    }
    answer->second = hooked;
  }
  return answer->second;
}

} // namespace gnomon
