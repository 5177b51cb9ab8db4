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
class vtkPropCollection;
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
  int keys = 0;            ///< keysOf() it
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
  /// Begin a frame.
  /// @param props all of the renderer
  /// @param inputsHaveRun true if the mappers' filters have run for this frame
  /// @return true if no prop has changed, and each is plain, hidden or an annotation
  bool beginFrame(vtkPropCollection* props, bool inputsHaveRun);

  /// Return a prop if it is plain and unchanged since the last frame; else null.
  /// @param number in the renderer's order
  const PlainProp* unchanged(std::size_t number) const;

  /// Store a prop if it is a plain one. VTK has just called it opaque, and everything is up to
  /// date.
  /// @return true if so
  bool remember(std::size_t number, vtkActor* actor);

  std::size_t bytes() const;

private:
  struct Known
  {
    PlainProp plain;                   ///< without an actor for other props
    vtkProp* withoutSurface = nullptr; ///< a hidden prop, or an annotation
  };
  std::vector<Known> props_; ///< in the renderer's order
};

/// True if a renderer that draws a frame has asked all its props for their bounds first, as its
/// usual culler does: then their mappers have run their filters.
bool haveInputsRun(vtkRenderer* renderer);

} // namespace gnomon
