#include "plugin/scene/DrawnProps.h"

#include "plugin/scene/PropFinder.h"

#include "vtkMatrix4x4.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

#include <glm/gtc/type_ptr.hpp>

namespace gnomon
{

glm::dmat4 toGlm(vtkMatrix4x4* matrix)
{
  return glm::transpose(glm::make_mat4(&matrix->Element[0][0])); // VTK's elements go row by row
}

DrawnProps findDrawnProps(vtkRenderer* renderer, PropMemory& memory, TranslucentRole translucent)
{
  memory.cutouts.beginFrame();
  memory.images.beginFrame();
  memory.volumes.beginFrame();
  PropFinder finder(renderer, memory, translucent);
  vtkPropCollection* viewProps = renderer->GetViewProps();
  vtkCollectionSimpleIterator cookie;
  viewProps->InitTraversal(cookie);
  int number = 0;
  while (vtkProp* viewProp = viewProps->GetNextProp(cookie))
  {
    finder.addViewProp(viewProp, number++);
  }
  return finder.take();
}

} // namespace gnomon
