#pragma once

#include "plugin/scene/SurfaceExtraction.h"

#include "lights/vtkGnomonVersions.h"

#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractMapper;
class vtkMapper;
class vtkPolyData;
class vtkProp;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

struct Occluders;

/// The hook's facts about a surface that VTK is about to draw.
struct HookedSurface
{
  int index = -1; ///< into the drawn surfaces; -1 if the snapshot does not hold it
  bool receives = false;
  bool translucent = false;
  float facetHeight = 0.0f;                ///< largest of its surfaces' heights
  std::uint32_t primitivesPerInstance = 0; ///< of a surface that VTK draws as instances; else 0
  bool catches = false;                    ///< vtkGnomonPropKeys::SHADOW_CATCHER
};

/// Return the number of corners of the primitives that a mapper is about to draw as a surface; 0 if
/// it draws something else. Valid while VTK builds a program or hands it to a render pass.
int cornersOfPrimitives(vtkAbstractMapper* mapper, vtkProp* prop);

/// Finds the snapshot's surfaces when VTK draws them. VTK names a mapper and a prop with its
/// present matrix. For composite data and glyphs the mapper is one of the mapper's helpers. An
/// actor that hangs in an assembly several times is drawn with a different matrix each time.
class DrawnLookup
{
public:
  /// A surface of the snapshot as part of a prop.
  struct HeldSurface
  {
    vtkPolyData* data = nullptr;
    SurfaceCells cells = SurfaceCells::Polygons;
    std::uint32_t surface = 0; ///< index into Occluders::surfaces
    bool isGlyph = false;
    std::uint32_t instances = 1;
  };

  /// Remove all surfaces.
  /// @param props the number of the renderer's props whose surfaces are added
  void clear(std::size_t props);
  /// Add the opaque surfaces, at least one, that a prop draws with a mapper at a place. Glyphs are
  /// in the order in which VTK draws them.
  /// @param plainNumber PropRecords::numberOf() a PlainProp; none for others
  void add(const vtkProp* actor, const vtkMapper* mapper, const glm::dmat4& worldFromModel,
    std::vector<HeldSurface> held, std::optional<std::size_t> plainNumber);
  /// Set the actors that draw translucent receivers, and those that are seen through.
  void setDrawers(const std::vector<const void*>& translucentReceivers,
    const std::vector<const void*>& seenThrough);

  /// Clear the list of drawn surfaces.
  void beginFrame();
  /// True if the picture of receivers holds what is behind a prop.
  bool isSeenThrough(vtkProp* prop) const { return isAmong(prop, this->seenThrough_); }
  bool anySeenThrough() const { return !this->seenThrough_.empty(); }
  /// Return the facts about the surface that VTK is about to draw. A mapper's lines and points are
  /// not held. Surfaces of the translucent pass are not looked up in the snapshot.
  /// @param number PropRecords::numberOf() the prop
  HookedSurface find(vtkAbstractMapper* mapper, vtkProp* prop, std::optional<std::size_t> number,
    const Occluders& occluders);
  const std::vector<DrawnSurface>& drawnSurfaces() const { return this->drawnSurfaces_; }

  /// Return the bytes of memory in use.
  std::size_t bytes() const;

private:
  /// The drawer and its matrix. The drawer is an actor, or the mapper of an inner actor, or of one
  /// that VTK makes while it draws.
  struct Place
  {
    const void* drawer;
    glm::dmat4 worldFromModel;

    bool operator==(const Place& other) const
    {
      return this->drawer == other.drawer && this->worldFromModel == other.worldFromModel;
    }
  };
  struct PlaceHash
  {
    std::size_t operator()(const Place& place) const;
  };
  using HeldSurfaces = std::vector<HeldSurface>;

  /// A call of find() since the last beginFrame().
  struct Question
  {
    const HeldSurfaces* held;
    const vtkAbstractMapper* mapper;
    SurfaceCells cells;

    bool operator==(const Question& other) const
    {
      return this->held == other.held && this->mapper == other.mapper && this->cells == other.cells;
    }
  };
  struct QuestionHash
  {
    std::size_t operator()(const Question& question) const;
  };

  /// A plain prop's polygons, which its mapper draws in the same way until the next clear().
  struct PlainDrawing
  {
    const vtkMapper* mapper = nullptr;       ///< null for other props
    std::size_t held = 0;                    ///< index into held_
    std::array<double, 16> worldFromModel{}; ///< as VTK has it, row by row
    DrawnSurface::Block block;               ///< empty until it is drawn first
    std::uint32_t frame = 0;                 ///< number of the last one that has drawn it
    int index = -1;                          ///< into that frame's drawnSurfaces()
  };

  static bool isAmong(vtkProp* prop, const std::unordered_set<const void*>& drawers);
  PlainDrawing* plainHere(vtkProp* prop, std::optional<std::size_t> number);
  HookedSurface take(PlainDrawing& plain, const Occluders& occluders);
  std::pair<DrawnSurface, HookedSurface> matchBlocks(const HeldSurfaces& held,
    vtkAbstractMapper* mapper, SurfaceCells cells, const Occluders& occluders);
  const HeldSurfaces* heldBy(vtkProp* prop) const;
  const HeldSurface* match(const HeldSurfaces& held, vtkPolyData* data, SurfaceCells cells);

  std::vector<HeldSurfaces> held_;
  /// Indices into held_ of surfaces that are in no PlainDrawing.
  std::unordered_map<Place, std::size_t, PlaceHash> heldAt_;
  std::vector<PlainDrawing> plain_; ///< by numbers of props
  std::uint32_t frame_ = 0;         ///< number of the present one
  std::unordered_map<Question, HookedSurface, QuestionHash> answers_;
  std::unordered_set<const void*> translucentReceivers_;
  std::unordered_set<const void*> seenThrough_;
  std::unordered_set<const HeldSurface*> taken_; ///< glyphs whose helper is known
  std::vector<DrawnSurface> drawnSurfaces_;
};

} // namespace gnomon
