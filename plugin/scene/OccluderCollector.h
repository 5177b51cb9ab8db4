#pragma once

#include "plugin/scene/DrawnLookup.h"
#include "plugin/scene/PropMemory.h"
#include "plugin/scene/SnapshotSurfaces.h"

#include "lights/vtkGnomonVersions.h"

#include "shadowtech/base/Receivers.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractMapper;
class vtkProp;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// How a collector reads a renderer's props.
struct CollectOptions
{
  bool readsNormals = false;  ///< surfaces get the normals that VTK shades them with
  bool inputsHaveRun = false; ///< plain props need no update, see haveInputsRun()
  TranslucentRole translucent = {};
};

/// Fills the snapshot from a renderer's visible props, in view or not, and keeps it up to date at
/// the price of what changed.
///
/// It holds what VTK draws as triangles in its opaque pass: surfaces of vtkActors, alone or in
/// assemblies, as followers or as levels of detail, whose mapper is a vtkPolyDataMapper, a
/// vtkDataSetMapper, a vtkCompositePolyDataMapper (2 or not) or a vtkGlyph3DMapper; and translucent
/// ones that are asked to cast.
/// With them goes what a texture cuts out of them (TextureCutouts). Image slices that are asked to
/// cast are held as their rectangles.
/// A polydata with polygons and strips makes two surfaces; a glyph makes one surface, with its
/// instances or with the triangles of all of them (KeptInstances.h). Front and back are OpenGL's: a
/// triangle's front is the side that shows its corners counter-clockwise after the prop's matrix.
/// So a mirroring matrix swaps the sides, as it does for gl_FrontFacing and VTK's face culling.
class OccluderCollector
{
public:
  /// Brings the snapshot up to date with the renderer's props. Updates the mappers' inputs first,
  /// as VTK would when drawing.
  /// @param ranks that share the frame
  SnapshotChange collect(
    vtkRenderer* renderer, CollectOptions options = {}, Ranks& ranks = alone());

  const Occluders& occluders() const { return this->surfaces_.occluders(); }
  /// One for each of the snapshot's surfaces.
  const std::vector<SurfaceRecord>& records() const { return this->surfaces_.records(); }

  /// The renderer's prop that a surface of the snapshot is of; only to be compared.
  const vtkProp* propOf(std::size_t surface) const
  {
    return this->surfaces_.records()[surface].key.viewProp;
  }

  /// Notes of the last collect(): visible, opaque props that it left out (their mappers are not
  /// served), and surfaces that it could not read in full.
  const std::vector<std::string>& notes() const { return this->notes_; }
  /// As in DrawnProps, of the last collect().
  const std::vector<std::string>& leftOut() const { return this->leftOut_; }

  /// The number of DrawnProps::translucentReceivers, as of the last collect().
  std::size_t translucentReceivers() const { return this->translucentReceivers_; }
  /// DrawnProps::anyCatcher of the same.
  bool anyCatcher() const { return this->anyCatcher_; }
  /// DrawnProps::volumeReceivers, as of the last collect().
  int volumeReceivers() const { return this->volumeReceivers_; }
  /// DrawnProps::pointsWorld in centred coordinates, as of the last collect().
  Bounds pointsCentred() const;
  ///@{
  /// As in DrawnLookup, of the last collect().
  bool isSeenThrough(vtkProp* prop) const { return this->lookup_.isSeenThrough(prop); }
  bool anySeenThrough() const { return this->lookup_.anySeenThrough(); }
  ///@}

  /// The renderer's props, of the frame that collect() has begun.
  PropRecords& props() { return this->propMemory_.records; }

  /// Memory that all this holds: the snapshot, and what is remembered of each surface and prop.
  std::size_t bytes() const;

  /// Finds the surface that `mapper` (a mapper, or its helper) draws for `prop`, with the matrix
  /// that the prop has at this moment. Called while VTK draws, from
  /// vtkOpenGLRenderPass::SetShaderParameters.
  HookedSurface drawn(vtkAbstractMapper* mapper, vtkProp* prop);

  /// How primitive numbers of drawn surfaces lead to the snapshot (Receivers.h). Entries are added
  /// by drawn(), and stay until the next collect().
  const std::vector<DrawnSurface>& drawnSurfaces() const { return this->lookup_.drawnSurfaces(); }

private:
  void indexProps(const std::vector<WantedSurface>& wanted);
  void noteWhatIsTooLarge(const std::vector<WantedSurface>& wanted);
  std::string noteOnBoxes(const std::vector<WantedSurface>& wanted) const;

  SnapshotSurfaces surfaces_;
  /// CollectOptions::readsNormals and translucent, and Ranks::serial(), of the snapshot; none after
  /// an error.
  std::optional<std::tuple<bool, TranslucentRole, std::uint64_t>> collected_;
  DrawnLookup lookup_;
  std::size_t numberings_ = 0; ///< PropRecords::numberings() of the lookup
  PropMemory propMemory_;
  std::size_t translucentReceivers_ = 0;
  bool anyCatcher_ = false;
  int volumeReceivers_ = 0;
  Bounds pointsWorld_;
  std::vector<std::string> notes_;
  std::string noteOnBoxes_; ///< as of the last change
  std::vector<std::string> leftOut_;
};

} // namespace gnomon
