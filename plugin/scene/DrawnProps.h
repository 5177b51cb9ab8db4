#pragma once

#include "plugin/scene/DrawnBlocks.h"

#include "lights/Bounds.h"
#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkMapper;
class vtkMatrix4x4;
class vtkProp;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

struct CutoutMask;
struct PropMemory;
struct Volume;

/// Return a VTK matrix as a GLM matrix of the same transformation.
glm::dmat4 toGlm(vtkMatrix4x4* matrix);

/// One leaf prop on one path of a view prop, with the surfaces that VTK draws of it in the opaque
/// or in the translucent pass. Pointers are valid until the scene changes.
struct DrawnProp
{
  vtkProp* viewProp = nullptr; ///< the renderer's prop: the actor itself, or the assembly above it
  int number = -1;             ///< the view prop's in vtkRenderer::GetViewProps()
  std::size_t path = 0;        ///< index among the view prop's paths
  vtkActor* actor = nullptr;   ///< as VTK hands it to a render pass: for followers, an inner one
  vtkMapper* mapper = nullptr;
  glm::dmat4 worldFromModel{ 1.0 };
  /// The mapper's clipping planes in world coordinates, as (n, d). VTK draws where n.x + d >= 0.
  std::vector<glm::dvec4> clipPlanes;

  bool casts = true;
  bool receives = true;
  bool oneSided = false;
  bool isMoved = false;     ///< a user's shader code may move its vertices
  bool translucent = false; ///< listed because it casts
  int transmits = 0;        ///< vtkGnomonPropKeys::TransmitsType of a translucent one
  bool isPlain = false;     ///< the actor is a PlainProp

  std::shared_ptr<const CutoutMask> cutout; ///< a texture's holes in its blocks; null for none
  glm::mat4 textureTransform{ 1.0f };       ///< of the cut-out's coordinates (s, t, 0, 1)

  std::size_t firstBlock = 0; ///< index into DrawnProps::blocks
  std::size_t blockCount = 0;
};

struct DrawnProps
{
  std::vector<DrawnProp> props;
  /// The blocks of all props. vtkPolyDataMapper and vtkDataSetMapper have one. Mappers of composite
  /// data and vtkGlyph3DMapper have any number, each polydata once. vtkMoleculeMapper has atoms and
  /// bonds.
  std::vector<DrawnBlock> blocks;
  std::vector<std::shared_ptr<const Volume>> volumes; ///< that cast
  ///@{
  /// Actors as VTK hands them to a render pass, each followed by its mapper unless it is a
  /// vtkOpenGLActor: ParaView's actors draw by an inner one, which has the mapper.
  std::vector<const void*> translucentReceivers; ///< that receive, or are seenThrough and receive
  /// The picture of receivers holds what is behind them (isSeenThrough(), hasOwnFramebuffer()).
  std::vector<const void*> seenThrough;
  ///@}
  bool anyCatcher = false; ///< a prop shows nothing but shadows
  int volumeReceivers = 0;
  /// The box around what these and translucentReceivers draw, in world coordinates; empty if a
  /// shader places some of it.
  Bounds pointsWorld;
  /// Kinds of props that are visible and lit but left out, each once.
  std::vector<std::string> leftOut;
  /// Sentences: each kind left out with its number of props, and effects that shadows of other
  /// props do not show.
  std::vector<std::string> notes;
};

/// The role of translucent props and of volumes.
struct TranslucentRole
{
  bool casts = false;         ///< translucent props cast without being asked
  bool transmits = true;      ///< those that cast let light through; else surfaces block it
  bool volumesCast = false;   ///< without being asked, if they let light through
  bool volumesReceive = true; ///< where VTK's shaders light them

  bool operator==(const TranslucentRole& other) const
  {
    return this->casts == other.casts && this->transmits == other.transmits &&
      this->volumesCast == other.volumesCast && this->volumesReceive == other.volumesReceive;
  }
};

/// List the surfaces that a renderer's opaque pass draws, and the translucent surfaces that cast.
/// Props out of the camera's view are included. Updates the inputs of mappers first, as VTK does
/// when it draws.
///
/// @param memory the same for all frames of the renderer. Its plain props have begun the frame.
DrawnProps findDrawnProps(vtkRenderer* renderer, PropMemory& memory, TranslucentRole translucent);

} // namespace gnomon
