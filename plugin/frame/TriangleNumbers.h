#pragma once

#include "lights/vtkGnomonVersions.h"

#include "shadowtech/base/NumberCheck.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkShaderProgram;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Which programs of a pass name the triangles that they draw, and whether their numbers are right.
/// Each program is checked once, in the first frame in which it draws receivers.
class TriangleNumbers
{
public:
  /// A stage is about to draw receivers.
  void beginStage();
  /// A program is about to draw one of the drawn surfaces.
  /// @param movesVertices whether it has shaders of a user's own. The snapshot need not hold what
  /// these draw, so their numbers are believed. So are those by geometry shaders of VTK, which
  /// enlarge triangles to draw edges.
  void add(vtkShaderProgram* program, int drawnSurface, bool movesVertices);
  bool isNew(const vtkShaderProgram* program) const { return this->known_.count(program) == 0; }

  /// True if a program of this stage is to be checked.
  bool isDue() const { return !this->compared_.empty(); }
  /// Compares what these programs have drawn; they count as checked then.
  NumberCheck check(const ReceiverImages& images, const std::vector<float>& windowDepths,
    const std::vector<DrawnSurface>& drawnSurfaces, const Occluders& occluders,
    const glm::dmat4& clipFromCentred);

private:
  std::set<const vtkShaderProgram*> known_; ///< checked, or believed
  std::set<const vtkShaderProgram*> added_; ///< in this stage, to be checked
  std::vector<std::uint8_t> compared_;      ///< by drawn surface, 1 for those of `added_`
};

/// A geometry shader that draws a vertex shader's primitives as they are and gives the fragment
/// shader their numbers, as `flat in int gnomonPrimitiveGSOutput`.
/// @param vertexShader whose outputs it passes on
/// @param corners of a primitive: 1, 2 or 3
/// @return empty if an output has no name that VTK would have the fragment shader read from a
/// geometry shader
std::string numberingShader(const std::string& vertexShader, int corners);

} // namespace gnomon
