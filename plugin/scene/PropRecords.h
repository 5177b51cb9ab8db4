#pragma once

#include "plugin/scene/PropStamps.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include "lights/vtkGnomonVersions.h"

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
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

/// A renderer's props from frame to frame, in its order: which are plain, and a stamp of what each
/// one's picture depends on. It dereferences a pointer only if times show that its owner has not
/// changed.
class PropRecords
{
public:
  /// Begin a frame.
  /// @param props all of the renderer
  /// @param inputsHaveRun true if the mappers' filters have run for this frame
  /// @return true if no prop has changed, and each is plain, hidden or an annotation
  bool beginFrame(vtkPropCollection* props, bool inputsHaveRun);

  /// Return a prop's number in the renderer's order; none of other props.
  std::optional<std::size_t> numberOf(const vtkProp* prop);

  /// Return how many times props got other numbers.
  std::size_t numberings() const { return this->numberings_; }

  /// Return a prop if it is plain and unchanged since the last frame; else null.
  /// @param number in the renderer's order
  const PlainProp* unchanged(std::size_t number) const;

  /// Store a prop if it is a plain one. VTK has just called it opaque, and everything is up to
  /// date.
  /// @return true if so
  bool remember(std::size_t number, vtkActor* actor);

  /// Return a prop's stamp before it is drawn, from the last frame if the prop is plain and
  /// unchanged. Changes that VTK makes whenever it draws a prop, as to the matrix of a text that
  /// faces the camera, are no changes of the prop: else nothing that refines would finish.
  std::size_t stamp(vtkProp* prop, vtkRenderer* renderer);

  /// End a frame, after VTK has drawn the props.
  void endFrame(vtkRenderer* renderer);

  /// Return a sentence for each kind of prop and mapper that is unknown.
  std::vector<std::string> notes() const;

  std::size_t bytes() const;

private:
  struct Record
  {
    const vtkProp* prop = nullptr;
    PlainProp plain;                ///< without an actor for other props
    bool withoutSurface = false;    ///< a hidden prop, or an annotation
    PropStamp last;                 ///< the last one found
    std::size_t stamp = 0;          ///< the last one whose change no drawing made but the first
    bool isStamped = false;         ///< `last` is the prop's own, in this frame
    bool mayChangeInDrawing = true; ///< new, or changed by the last drawing
    bool wasDrawn = false;          ///< since it is new, or last changed
  };
  std::vector<Record> records_;                             ///< in the renderer's order
  std::unordered_map<const vtkProp*, std::size_t> numbers_; ///< once they are asked for
  std::size_t numberings_ = 0;
  std::size_t next_ = 0; ///< number of the next prop, if VTK asks for them in this order
  /// Records whose props are to be looked at after drawing.
  std::vector<std::pair<std::size_t, vtkSmartPointer<vtkProp>>> due_;
};

/// True if a renderer that draws a frame has asked all its props for their bounds first, as its
/// usual culler does: then their mappers have run their filters.
bool haveInputsRun(vtkRenderer* renderer);

} // namespace gnomon
