#include "plugin/scene/ShownScene.h"

#include "lights/vtkGnomonAreaLight.h"
#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/Hash.h"

#include <vtkAssemblyPath.h>
#include <vtkCollection.h>
#include <vtkDataSet.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

namespace gnomon
{
namespace
{

/// Hash an object and the time of its last change.
template <typename Object>
void hashObject(std::size_t& seed, Object* object)
{
  hashCombine(seed, object);
  hashCombine(seed, object ? object->GetMTime() : 0);
}

/// Hash the surfaces, on which shadows depend.
void hashDrawn(std::size_t& seed, const DrawnProps& drawn)
{
  for (const DrawnProp& prop : drawn.props)
  {
    hashCombine(seed, prop.viewProp);
    hashCombine(seed, prop.path);
    hashObject(seed, prop.mapper);
    hashMatrix(seed, prop.worldFromModel);
    for (const glm::dvec4& plane : prop.clipPlanes)
    {
      for (int i = 0; i < 4; ++i)
      {
        hashCombine(seed, plane[i]);
      }
    }
    hashCombine(seed, prop.casts);
    hashCombine(seed, prop.receives);
    hashCombine(seed, prop.oneSided);
    hashCombine(seed, prop.isMoved);
    hashCombine(seed, prop.cutout.get());
  }
  for (const DrawnBlock& block : drawn.blocks)
  {
    hashObject(seed, block.data);
    hashObject(seed, block.glyphPoints);
  }
  for (const vtkProp* receiver : drawn.translucentReceivers)
  {
    hashCombine(seed, receiver);
  }
}

/// Hash the other changes of props that have times: colours, textures, annotations, volumes.
void hashProp(std::size_t& seed, vtkProp* prop)
{
  hashCombine(seed, prop);
  hashCombine(seed, prop->GetVisibility());
  prop->InitPathTraversal();
  while (vtkAssemblyPath* path = prop->GetNextPath())
  {
    vtkProp* part = path->GetLastNode()->GetViewProp();
    hashCombine(seed, part);
    hashCombine(seed, part->GetVisibility());
    hashCombine(seed, part->GetRedrawMTime());
  }
}

/// Hash the renderer's other settings. Its own MTime also changes with selections and drawing.
void hashSurroundings(std::size_t& seed, vtkRenderer* renderer)
{
  for (const double* triple : { renderer->GetBackground(), renderer->GetBackground2(),
         renderer->GetAmbient(), renderer->GetEnvironmentUp(), renderer->GetEnvironmentRight() })
  {
    for (int i = 0; i < 3; ++i)
    {
      hashCombine(seed, triple[i]);
    }
  }
  hashCombine(seed, renderer->GetBackgroundAlpha());
  hashCombine(seed, renderer->GetGradientBackground());
  hashCombine(seed, renderer->GetTexturedBackground());
  hashObject(seed, renderer->GetBackgroundTexture());
  hashCombine(seed, renderer->GetUseImageBasedLighting());
  hashObject(seed, renderer->GetEnvironmentTexture());
  hashCombine(seed, renderer->GetTwoSidedLighting());
  hashCombine(seed, renderer->GetUseShadows()); // passes may obey it
}

void hashLight(std::size_t& seed, vtkLight* light)
{
  hashObject(seed, light);
  hashObject(seed, light->GetTransformMatrix());
  hashObject(seed, light->GetInformation());
  if (auto* area = vtkGnomonAreaLight::SafeDownCast(light))
  {
    hashObject(seed, area->GetTexture());
  }
}

} // namespace

//------------------------------------------------------------------------------
std::size_t ShownScene::hash(vtkRenderer* renderer)
{
  std::size_t seed = 0;
  hashSurroundings(seed, renderer);
  hashDrawn(seed, findDrawnProps(renderer, this->propMemory_));
  vtkCollectionSimpleIterator iterator;
  vtkPropCollection* props = renderer->GetViewProps();
  props->InitTraversal(iterator);
  while (vtkProp* prop = props->GetNextProp(iterator))
  {
    hashProp(seed, prop);
  }
  vtkLightCollection* lights = renderer->GetLights();
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    hashLight(seed, light);
  }
  return seed;
}

} // namespace gnomon
