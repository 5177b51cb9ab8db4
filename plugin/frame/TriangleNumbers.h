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

/// Which programs of a pass write triangle numbers, and whether these are right. Each program is
/// checked once, in the first frame in which it draws receivers.
class TriangleNumbers
{
public:
  /// Begin a stage that draws receivers.
  void beginStage();
  /// Add a program that is about to draw one of the drawn surfaces.
  /// @param movesVertices true if it has shaders of a user's own. The snapshot need not hold their
  /// triangles, so their numbers are trusted. So are those of VTK's geometry shaders, which enlarge
  /// triangles to draw edges.
  void add(vtkShaderProgram* program, int drawnSurface, bool movesVertices);
  bool isNew(const vtkShaderProgram* program) const { return this->known_.count(program) == 0; }

  /// True if a program of this stage must be checked.
  bool isDue() const { return !this->compared_.empty(); }
  /// Compare the pixels of these programs with the snapshot, and count the programs as checked.
  NumberCheck check(const ReceiverImages& images, const std::vector<float>& windowDepths,
    const std::vector<DrawnSurface>& drawnSurfaces, const Occluders& occluders,
    const glm::dmat4& clipFromCentred);

private:
  std::set<const vtkShaderProgram*> known_; ///< checked, or trusted
  std::set<const vtkShaderProgram*> added_; ///< in this stage, to be checked
  std::vector<std::uint8_t> compared_;      ///< by drawn surface, 1 for those of `added_`
};

/// Return a geometry shader that draws a vertex shader's primitives unchanged and hands the
/// fragment shader their numbers, as `flat in int gnomonPrimitiveGSOutput`.
/// @param vertexShader whose outputs it hands on
/// @param corners of a primitive: 1, 2 or 3
/// @return empty if VTK cannot redirect the fragment shader from one of the outputs by its name
std::string numberingShader(const std::string& vertexShader, int corners);

} // namespace gnomon
