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

/// A polydata that a vtkGlyph3DMapper draws at the points of a data set, once for each of the
/// points that choose it.
struct Glyph
{
  vtkPolyData* data = nullptr;
  vtkDataSet* points = nullptr;
  int source = 0; ///< its place in the mapper's table of sources
};

/// What a mapper draws, in the order in which it does. A source that is a tree gives all its
/// leaves. Empty where VTK refuses to draw.
std::vector<Glyph> drawnGlyphs(vtkGlyph3DMapper* mapper);

/// From a glyph to the mapper's model coordinates, for each of its instances in the order of their
/// gl_InstanceID. As floats, like the matrices that VTK's vertex shader gets. A mask, the index of
/// the source, scale and orientation count as in vtkOpenGLGlyph3DMapper.
std::vector<glm::mat4> glyphInstances(vtkGlyph3DMapper* mapper, vtkDataSet* points, int source);

} // namespace gnomon
