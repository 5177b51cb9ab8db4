#pragma once

#include "lights/vtkGnomonVersions.h"

#include "plugin/frame/NumberCheck.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkShaderProgram;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Which programs of a pass write triangle numbers, and whether these are right. A program is
/// checked in the first frame that shows its receivers, and again with meshes of twice as many
/// triangles: numbers may be wrong in long draws alone.
class TriangleNumbers
{
public:
  /// Begin a stage that draws receivers.
  void beginStage() { this->added_.clear(); }
  /// True if a program is not checked yet with a surface of so many primitives.
  bool isNew(vtkShaderProgram* program, std::uint32_t primitives) const;
  /// Add a new program that is about to draw one of the drawn surfaces. Geometry shaders of VTK
  /// enlarge triangles to draw edges, so their numbers are trusted.
  void add(vtkShaderProgram* program, std::uint32_t primitives, int drawnSurface);

  /// True if programs of this stage must be checked. Surfaces that no pixel shows are looked for
  /// after 1, 2, 4... stages.
  bool isDue();
  /// Compare the pixels of these programs with the snapshot. Programs with pixels count as checked.
  NumberCheck check(const ReceiverImages& images, const NumberTruth& truth,
    const std::vector<DrawnSurface>& drawnSurfaces, const Occluders& occluders);

private:
  /// A program, and the bits of the number of primitives.
  using Draw = std::pair<const vtkShaderProgram*, int>;
  std::set<Draw> known_;                   ///< checked, or trusted
  std::map<Draw, std::vector<int>> added_; ///< in this stage, with their drawn surfaces
  std::set<Draw> waiting_;                 ///< whose surfaces no pixel showed at the last check
  int stagesWaited_ = 0;
};

/// Make the vertex shader hand the drawn surface's number and the instance's first primitive to the
/// fragment shader, as `gnomonDrawnVSOutput` (hook_drawn.vert.glsl). Call it before VTK's
/// replacements.
/// @return the fragment shader's declarations. They read the uniform, without instances, if the
/// vertex shader's main is not found or a geometry shader lacks VTK's marks.
std::string handOnDrawn(std::string& vertexShader, std::string& geometryShader);

/// Return a geometry shader that draws a vertex shader's primitives unchanged and hands the
/// fragment shader their numbers, as `flat in int gnomonPrimitiveGSOutput`.
/// @param vertexShader whose outputs it hands on
/// @param corners of a primitive: 1, 2 or 3
/// @return empty if VTK cannot redirect the fragment shader from one of the outputs by its name
std::string numberingShader(const std::string& vertexShader, int corners);

} // namespace gnomon
