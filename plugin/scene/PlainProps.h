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
class vtkRenderer;
class vtkShaderProperty;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// An actor that draws a polydata as an opaque surface. It has no textures, no clipping planes and
/// no shader code that moves vertices. Most props of large scenes are plain.
///
/// Asking VTK for these facts takes thousands of instructions and visits twenty objects. The facts
/// follow from the actor, its property, its shader code, its mapper with its colours and its list
/// of planes, the producer of the polydata, and the polydata with its arrays. Each has, or hands
/// on, the time of its last change. No two times are equal, and an object that gets another part
/// gets another time. So while these times are the same, the objects and VTK's answers are, too.
struct PlainProp
{
  vtkActor* actor = nullptr;
  vtkMapper* mapper = nullptr;
  vtkAlgorithm* producer = nullptr;
  bool isFiltered = false; ///< the producer is a filter to be run, not data that was set by hand
  vtkPolyData* data = nullptr;
  vtkShaderProperty* code = nullptr;
  vtkMTimeType actorTime = 0;
  vtkMTimeType mapperTime = 0;
  vtkMTimeType dataTime = 0; ///< of the data, or of the producer that hands on its time
  vtkMTimeType codeTime = 0;
};

/// Caches from frame to frame which props are plain. It dereferences a pointer only if times show
/// that its owner has not changed.
class PlainProps
{
public:
  /// Begin a frame. It must ask for all props of the renderer, in its order.
  /// @param inputsHaveRun true if the mappers' filters have run for this frame
  void beginFrame(bool inputsHaveRun);

  /// Return the renderer's next prop if it is unchanged since the last frame; else null.
  const PlainProp* next(vtkProp* prop);

  /// Store the prop of the last call of next(), if it is a plain one. VTK has just called it
  /// opaque, and everything is up to date.
  void remember(vtkActor* actor);

  /// End a frame: drop props beyond the last one asked for.
  void endFrame() { this->props_.resize(this->next_); }

  std::size_t bytes() const;

private:
  std::vector<PlainProp> props_; ///< in the renderer's order; empty for other props
  std::size_t next_ = 0;
  bool inputsHaveRun_ = false;
};

/// True if a renderer that draws a frame has asked all its props for their bounds first, as its
/// usual culler does: then their mappers have run their filters.
bool haveInputsRun(vtkRenderer* renderer);

} // namespace gnomon
