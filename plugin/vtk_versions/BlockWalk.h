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

/// What a block's scalars are, and what colours them.
struct BlockScalars
{
  BlockScalars(vtkMapper* mapper, bool perBlock);
  /// Takes what a composite data set's attributes set for one of its objects.
  void takeFrom(vtkCompositeDataDisplayAttributes* attributes, vtkDataObject* object);
  /// True if no colour of the scalars is translucent, or none is shown.
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

/// Walks a composite data set as VTK's BuildRenderValues does: the innermost setting on the way to
/// a block counts, so that a visible block may hang below a hidden one. A block that appears twice
/// is drawn once, with the settings of its last place.
class BlockWalk
{
public:
  /// @param scalarsPerBlock whether the mapper lets attributes set a block's scalars
  BlockWalk(vtkActor* actor, vtkMapper* mapper, vtkCompositeDataDisplayAttributes* attributes,
    bool scalarsPerBlock);

  /// The polydata that one of the passes draws, in the order of the tree.
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
