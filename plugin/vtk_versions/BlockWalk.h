#pragma once

#include "lights/vtkGnomonVersions.h"

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkCompositeDataDisplayAttributes;
class vtkDataObject;
class vtkMapper;
class vtkPolyData;
class vtkScalarsToColors;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// A block's scalars and their colours.
struct BlockScalars
{
  BlockScalars(vtkMapper* mapper, bool perBlock);
  /// Copy the settings of a composite data set's attributes for one of its objects.
  void takeFrom(vtkCompositeDataDisplayAttributes* attributes, vtkDataObject* object);
  /// True if no colour of the scalars is translucent, or if scalars are not shown.
  bool areOpaque(vtkPolyData* data) const;

  bool shown;
  int mode;
  int accessMode;
  int arrayId;
  std::string arrayName;
  int component;
  int colourMode;
  vtkScalarsToColors* colours;
};

/// Walks a composite data set like VTK's BuildRenderValues. The innermost setting on the way to a
/// block counts, so a visible block may hang below a hidden one. A block that appears twice is
/// drawn once, with the settings of its last place.
class BlockWalk
{
public:
  /// @param scalarsPerBlock true if the mapper lets attributes set a block's scalars
  BlockWalk(vtkActor* actor, vtkMapper* mapper, vtkCompositeDataDisplayAttributes* attributes,
    bool scalarsPerBlock);

  /// Return the polydata that one of the passes draws, in the order of the tree.
  std::vector<vtkPolyData*> drawn(bool translucent) const;

private:
  struct Block
  {
    vtkPolyData* data;
    bool visible;
    bool opaque;
  };

  void walk(vtkDataObject* object, bool visible, double opacity, const BlockScalars& scalars);
  void add(vtkDataObject* object, bool visible, double opacity, const BlockScalars& scalars);

  vtkCompositeDataDisplayAttributes* attributes_;
  bool scalarsPerBlock_;
  bool forceOpaque_;
  bool textureOpaque_;
  std::vector<Block> blocks_;
  std::unordered_map<vtkPolyData*, std::size_t> placeOf_;
};

} // namespace gnomon
