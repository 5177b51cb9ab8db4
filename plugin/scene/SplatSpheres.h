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

/// Why a mapper's splats cast as no spheres; null if they do.
const char* reasonAgainstSplats(vtkPointGaussianMapper* mapper);

/// The polydata whose points a mapper draws.
/// @param mapper whose input is up to date
std::vector<vtkPolyData*> splatBlocks(vtkPointGaussianMapper* mapper);

/// When the mapper of a block's solids, or what it takes their sizes from, changed last.
vtkMTimeType sizesTime(vtkMapper* solids);

struct SplatSphere
{
  vtkIdType point;
  double radius; ///< in the world: an actor's matrix does not change it
};

/// The spheres of a block: the discs' radii are where a splat's offset has length 1, as
/// vtkOpenGLPointGaussianMapper places its corners.
std::vector<SplatSphere> splatSpheres(vtkPointGaussianMapper* mapper, vtkPolyData* data);

} // namespace gnomon
