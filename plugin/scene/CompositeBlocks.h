#pragma once

#include <vector>

class vtkActor;
class vtkCompositePolyDataMapper2;
class vtkPolyData;

namespace gnomon
{

/// The polydata that a composite mapper draws for an actor, each one once, in the order of the
/// tree: what the opaque pass draws, or what the translucent pass draws.
std::vector<vtkPolyData*> drawnBlocks(
  vtkActor* actor, vtkCompositePolyDataMapper2* mapper, bool translucent);

} // namespace gnomon
