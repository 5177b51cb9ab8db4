#ifndef gnomon_plugin_DrawnProps_h
#define gnomon_plugin_DrawnProps_h

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

class vtkActor;
class vtkMatrix4x4;
class vtkPolyData;
class vtkProp;
class vtkRenderer;

namespace gnomon
{

/// A VTK matrix as GLM's: the same transformation.
glm::dmat4 toGlm(vtkMatrix4x4* matrix);

/// One leaf prop on one path of a view prop, with the surfaces that VTK draws of it in the opaque
/// pass. Pointers are valid until the scene is next changed.
struct DrawnProp
{
  vtkProp* viewProp = nullptr; ///< the renderer's prop: the actor itself, or the assembly above it
  std::size_t path = 0;        ///< the path's number among the view prop's paths
  vtkActor* actor = nullptr;
  glm::dmat4 worldFromModel{ 1.0 };
  /// The mapper's clipping planes in world coordinates: (n, d), n.x + d >= 0 where it draws.
  std::vector<glm::dvec4> clipPlanes;

  bool casts = true;
  bool receives = true;
  bool oneSided = false;

  std::size_t firstBlock = 0; ///< into DrawnProps::blocks
  std::size_t blockCount = 0;
};

struct DrawnProps
{
  std::vector<DrawnProp> props;
  /// The polydata that the props draw: one for vtkPolyDataMapper, any number for
  /// vtkCompositePolyDataMapper2, each one once.
  std::vector<vtkPolyData*> blocks;
  /// What was left out although it may be opaque and visible, and why.
  std::vector<std::string> notes;
};

/// Lists what a renderer's opaque pass draws as surfaces, in the camera's view or not, bringing the
/// inputs of mappers up to date first, as VTK does when it draws.
DrawnProps findDrawnProps(vtkRenderer* renderer);

} // namespace gnomon

#endif
