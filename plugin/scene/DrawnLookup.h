#pragma once

#include "plugin/scene/SurfaceExtraction.h"

#include "lights/vtkGnomonVersions.h"

#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
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

/// What the hook needs to know of a surface that VTK is about to draw.
struct Drawn
{
  int index = -1; ///< into the drawn surfaces; -1 when the snapshot does not hold it
  bool receives = false;
  bool translucent = false;
  float facetHeight = 0.0f;                ///< the largest of its surfaces'
  std::uint32_t primitivesPerInstance = 0; ///< for a surface that is drawn as instances
};

/// How many corners the primitives have that a mapper is about to draw as a surface; 0 if it draws
/// something else. While VTK builds a program, or hands it to a render pass.
int cornersOfPrimitives(vtkAbstractMapper* mapper, vtkProp* prop);

/// Finds the snapshot's surfaces again when VTK draws them. VTK names a mapper (of a composite data
/// set or of glyphs, one of the mapper's helpers) and a prop, which has its matrix at that moment:
/// an actor that hangs in an assembly several times is drawn with another matrix each time.
class DrawnLookup
{
public:
  /// A surface of the snapshot as part of a prop.
  struct HeldSurface
  {
    vtkPolyData* data = nullptr;
    SurfaceCells cells = SurfaceCells::Polygons;
    std::uint32_t surface = 0; ///< Occluders::surfaces index
    bool isGlyph = false;
    std::uint32_t instances = 1;
  };

  /// Forgets all surfaces.
  void clear();
  /// Takes over the opaque surfaces, at least one, that a prop draws with a mapper at a place;
  /// glyphs in the order in which they are drawn.
  void add(const vtkProp* actor, const vtkMapper* mapper, const glm::dmat4& worldFromModel,
    std::vector<HeldSurface> held);

  /// Empties the list of drawn surfaces.
  /// @param translucentReceivers as in DrawnProps
  void beginFrame(const std::vector<const vtkProp*>& translucentReceivers);
  /// What VTK is about to draw. The lines and points of a mapper are not held; the surfaces of the
  /// translucent pass are not looked for in the snapshot.
  Drawn find(vtkAbstractMapper* mapper, vtkProp* prop, const Occluders& occluders);
  const std::vector<DrawnSurface>& drawnSurfaces() const { return this->drawnSurfaces_; }

  /// Memory that this holds.
  std::size_t bytes() const;

private:
  /// Who draws, and where: an actor, or for actors that VTK makes as it draws, their mapper.
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

  /// What find() was asked since the last beginFrame().
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

  const HeldSurfaces* heldBy(vtkProp* prop) const;
  const HeldSurface* match(const HeldSurfaces& held, vtkPolyData* data, SurfaceCells cells);

  std::vector<HeldSurfaces> held_;
  std::unordered_map<Place, std::size_t, PlaceHash> heldAt_; ///< numbers in held_
  std::unordered_map<Question, Drawn, QuestionHash> answers_;
  std::unordered_set<const vtkProp*> translucentReceivers_;
  std::unordered_set<const HeldSurface*> taken_; ///< glyphs whose helper is known
  std::vector<DrawnSurface> drawnSurfaces_;
};

} // namespace gnomon
