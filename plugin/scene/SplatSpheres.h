#pragma once

#include "vtkType.h"

#include "lights/vtkGnomonVersions.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkMapper;
class vtkPointGaussianMapper;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Splats of a vtkPointGaussianMapper whose shader code cuts discs out of them. They show spheres
/// without any light, so they cast as spheres and receive nothing.

/// Return why a mapper's splats do not cast as spheres; null if they do.
const char* reasonAgainstSplats(vtkPointGaussianMapper* mapper);

/// Return the polydata at whose points a mapper draws.
/// @param mapper whose input is up to date
std::vector<vtkPolyData*> splatBlocks(vtkPointGaussianMapper* mapper);

/// Return the time of the last change of a block's mapper of solids, or of the inputs for their
/// sizes.
vtkMTimeType sizesTime(vtkMapper* solids);

struct SplatSphere
{
  vtkIdType point;
  double radius; ///< in world units: an actor's matrix does not change it
};

/// Return the spheres of a block. A disc's radius is where a splat's offset has length 1, as
/// vtkOpenGLPointGaussianMapper places its corners.
std::vector<SplatSphere> splatSpheres(vtkPointGaussianMapper* mapper, vtkPolyData* data);

} // namespace gnomon
