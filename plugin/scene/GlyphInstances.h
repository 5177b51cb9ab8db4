#pragma once

#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
class vtkGlyph3DMapper;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// A polydata that a vtkGlyph3DMapper draws at the points of a data set, once for each point that
/// selects it.
struct Glyph
{
  vtkPolyData* data = nullptr;
  vtkDataSet* points = nullptr;
  int source = 0; ///< its index in the mapper's table of sources
};

/// Return the glyphs that a mapper draws, in VTK's order. A source that is a tree gives all its
/// leaves. Empty if VTK refuses to draw.
std::vector<Glyph> drawnGlyphs(vtkGlyph3DMapper* mapper);

/// Return the matrix from a glyph to the mapper's model coordinates for each instance, in the order
/// of gl_InstanceID. They are floats, like the matrices in VTK's vertex shader. Mask, source index,
/// scale and orientation count as in vtkOpenGLGlyph3DMapper.
std::vector<glm::mat4> glyphInstances(vtkGlyph3DMapper* mapper, vtkDataSet* points, int source);

} // namespace gnomon
