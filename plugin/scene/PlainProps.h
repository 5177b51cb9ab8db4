#pragma once

#include "vtkType.h"

#include "lights/vtkGnomonVersions.h"

#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkAlgorithm;
class vtkMapper;
class vtkPolyData;
class vtkProp;
class vtkShaderProperty;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// An actor that draws a polydata, which was set by hand, as an opaque surface without textures,
/// clipping planes and shader code that moves vertices: what nearly every prop of a scene with many
/// is.
///
/// VTK takes thousands of instructions to say so, and leads through twenty objects. What it says
/// follows from the actor, its property, its shader code, its mapper with its colours and its list
/// of planes, the producer that stands for the polydata, and the polydata with its arrays. Each
/// has, or hands on, the time of its last change. No two times are the same, and an object that
/// gets another part gets another time. So while these are the same, so are the objects, and what
/// VTK would say.
struct PlainProp
{
  vtkActor* actor = nullptr;
  vtkMapper* mapper = nullptr;
  vtkAlgorithm* producer = nullptr;
  vtkPolyData* data = nullptr;
  vtkShaderProperty* code = nullptr;
  vtkMTimeType actorTime = 0;
  vtkMTimeType mapperTime = 0;
  vtkMTimeType producerTime = 0;
  vtkMTimeType codeTime = 0;
};

/// Remembers from one frame to the next which props are plain ones. Pointers are followed only
/// where times show that what holds them has not changed.
class PlainProps
{
public:
  /// Begins a frame, in which all props of a renderer are asked for, in its order.
  void beginFrame() { this->next_ = 0; }

  /// The renderer's next prop, if it is as it was remembered in the last frame; else null.
  const PlainProp* next(vtkProp* prop);

  /// Remembers the prop that was last asked for, if it is a plain one. VTK has just said that it is
  /// opaque, and everything is up to date.
  void remember(vtkActor* actor);

  /// Ends a frame: what was not asked for is forgotten.
  void endFrame() { this->props_.resize(this->next_); }

  std::size_t bytes() const;

private:
  std::vector<PlainProp> props_; ///< in the renderer's order; empty for the others
  std::size_t next_ = 0;
};

} // namespace gnomon
