#pragma once

#include "lights/vtkGnomonVersions.h"

// The mapper whose blocks share buffers, for scenes of tests and examples.
#if GNOMON_VTK_HAS_BLOCK_BATCHES
#include "vtkCompositePolyDataMapper.h"
#else
#include "vtkCompositePolyDataMapper2.h"
#endif

namespace gnomon
{

#if GNOMON_VTK_HAS_BLOCK_BATCHES
using SharedBlocksMapper = vtkCompositePolyDataMapper;
#else
using SharedBlocksMapper = vtkCompositePolyDataMapper2;
#endif

} // namespace gnomon
