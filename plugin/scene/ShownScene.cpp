#include "plugin/scene/ShownScene.h"

#include "lights/Hash.h"
#include "lights/LightManager.h"
#include "plugin/scene/PropStamps.h"

#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>

namespace gnomon
{
namespace
{

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
  hashTexture(seed, renderer->GetBackgroundTexture());
  hashCombine(seed, renderer->GetUseImageBasedLighting());
  hashTexture(seed, renderer->GetEnvironmentTexture());
  hashCombine(seed, renderer->GetTwoSidedLighting());
  hashCombine(seed, renderer->GetUseShadows()); // passes may obey it
}

} // namespace

std::size_t hashOfShownScene(vtkRenderer* renderer)
{
  std::size_t seed = 0;
  hashSurroundings(seed, renderer);
  vtkCollectionSimpleIterator iterator;
  vtkPropCollection* props = renderer->GetViewProps();
  props->InitTraversal(iterator);
  while (vtkProp* prop = props->GetNextProp(iterator))
  {
    hashCombine(seed, stampOf(prop, renderer).hash);
  }
  vtkLightCollection* lights = renderer->GetLights();
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    hashCombine(seed, light);
    hashCombine(seed, changeTime(light));
  }
  return seed;
}

} // namespace gnomon
