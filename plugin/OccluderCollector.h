#ifndef gnomon_plugin_OccluderCollector_h
#define gnomon_plugin_OccluderCollector_h

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"

#include <memory>
#include <string>
#include <vector>

class vtkAbstractMapper;
class vtkProp;
class vtkRenderer;

namespace gnomon
{

/// Fills the snapshot from a renderer's visible props, in view or not, and keeps it up to date at
/// the price of what changed.
///
/// It holds what VTK draws as triangles in its opaque pass: surfaces of vtkActors, alone or in
/// assemblies, whose mapper is a vtkPolyDataMapper or a vtkCompositePolyDataMapper2. A polydata
/// with polygons and strips makes two surfaces. Front and back are OpenGL's: a triangle's front is
/// the side that shows its corners counter-clockwise after the prop's matrix, so that a mirroring
/// matrix swaps the sides just as it does for gl_FrontFacing and VTK's face culling.
class OccluderCollector
{
public:
  OccluderCollector();
  ~OccluderCollector();

  /// What one call did.
  struct Change
  {
    int extracted = 0;     ///< surfaces whose mapper's input was read
    int retransformed = 0; ///< surfaces whose centred positions were computed again
  };

  /// Brings the snapshot up to date with the renderer's props. Updates the mappers' inputs first,
  /// as VTK would when drawing.
  Change collect(vtkRenderer* renderer);

  const Occluders& occluders() const;

  /// What the last collect() left out although it may be visible and opaque (mappers that are not
  /// served), and what it could not do for a surface, in words.
  const std::vector<std::string>& notes() const;

  /// What the hook needs to know of a surface that VTK is about to draw.
  struct Drawn
  {
    int index = -1; ///< into drawnSurfaces(); -1 when the snapshot does not hold it
    bool receives = false;
  };
  /// Finds the surface that `mapper` (a mapper, or a composite mapper's helper) draws for `prop`,
  /// with the matrix that the prop has at this moment. Called while VTK draws, from
  /// vtkOpenGLRenderPass::SetShaderParameters. The lines and points of its mapper are not held, nor
  /// is anything in the translucent pass.
  Drawn drawn(vtkAbstractMapper* mapper, vtkProp* prop);

  /// How primitive numbers of drawn surfaces lead to the snapshot (see projectReceivers). Entries
  /// are added by drawn(), and stay until the next collect().
  const std::vector<DrawnSurface>& drawnSurfaces() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon

#endif
