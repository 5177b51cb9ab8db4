#pragma once

#include <vector>

class vtkActor;
class vtkCompositePolyDataMapper;
class vtkCompositePolyDataMapper2;
class vtkPolyData;

namespace gnomon
{

/// The polydata that a composite mapper draws for an actor, each one once, in the order of the
/// tree: what the opaque pass draws, or what the translucent pass draws.
std::vector<vtkPolyData*> drawnBlocks(
  vtkActor* actor, vtkCompositePolyDataMapper2* mapper, bool translucent);

/// The same of the older mapper, which has a polydata mapper with a shallow copy for each. There,
/// the colours alone say in which pass a polydata is drawn.
std::vector<vtkPolyData*> drawnParts(vtkCompositePolyDataMapper* mapper, bool translucent);

} // namespace gnomon
