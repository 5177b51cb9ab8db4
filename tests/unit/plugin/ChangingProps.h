#pragma once

#include <vtkAbstractMapper.h>
#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkPlane.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkProp3D.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::test
{

/// A prop and the objects that it is drawn from; null where its kind has none.
struct ChangingProp
{
  vtkSmartPointer<vtkProp> prop;   ///< the renderer's
  vtkSmartPointer<vtkProp3D> leaf; ///< that is drawn: the prop itself, a part or a level
  vtkSmartPointer<vtkActor> actor; ///< the leaf, if it is one
  vtkSmartPointer<vtkAbstractMapper> mapper;
  vtkSmartPointer<vtkPlaneSource>
    source;                          ///< of a grid in the plane z = 0, to the data or the glyph
  vtkSmartPointer<vtkPolyData> data; ///< such a grid, set by hand
  vtkSmartPointer<vtkImageData> image;
  std::function<void()> changePart; ///< changes what only this kind has
};

/// A kind of prop. Most hide what lies below them, and have no surface that casts or receives.
struct PropKind
{
  const char* name;
  /// @param renderer is in a window
  ChangingProp (*make)(vtkRenderer* renderer);
  /// True if a surface in place of lines shows a square of half side 2 at height 1, as far as the
  /// clipping plane x = 1.5.
  bool isSurface = false;
  /// False if VTK chooses what it draws by the time that drawing takes, or reports errors with
  /// several renderers or without a light, or places a prop by how often it drew it.
  bool isRepeatable = true;
};
const std::vector<PropKind>& changingProps();

/// A kind of change.
struct PropChange
{
  const char* name;
  std::function<bool(const ChangingProp& prop)> isFor;
  void (*change)(const ChangingProp& prop);

  /// @return false if the prop has nothing to change
  bool apply(const ChangingProp& prop) const
  {
    const bool is = this->isFor(prop);
    is ? this->change(prop) : void();
    return is;
  }
};
const std::vector<PropChange>& propChanges();

} // namespace gnomon::test
