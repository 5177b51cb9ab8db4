#include "plugin/PointLights.h"

#include "lights/LightManager.h"
#include "lights/vtkGnomonLightKeys.h"

#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

namespace gnomon
{
namespace
{

/// Naming the member through a subclass gives access to it; the renderer's own function would tell all observers that
/// the renderer was modified.
struct RendererAccess : vtkRenderer
{
  static vtkLightCollection*& lights(vtkRenderer* renderer)
  {
    return renderer->*(&RendererAccess::Lights);
  }
};

/// The same light, without area, at its centre.
vtkSmartPointer<vtkLight> centreOf(vtkLight* light)
{
  auto centre = vtkSmartPointer<vtkLight>::New();
  centre->DeepCopy(light);
  LightManager::makePoint(centre);
  return centre;
}

/// Places a light in world coordinates.
void place(vtkLight* point, const ShadowLight& light, const glm::dvec3& offset)
{
  point->SetTransformMatrix(nullptr);
  point->SetLightTypeToSceneLight();
  const bool positional = light.kind != LightKind::Directional;
  const glm::dvec3 position = positional ? light.positionWorld + offset : light.positionWorld;
  // The area of a directional light lies at distance 1 from what it lights.
  const glm::dvec3 focalPoint =
    position + (positional ? light.directionWorld : light.directionWorld - offset);
  point->SetPosition(position.x, position.y, position.z);
  point->SetFocalPoint(focalPoint.x, focalPoint.y, focalPoint.z);
  if (light.box)
  {
    const LightBox& box = *light.box;
    vtkGnomonLightKeys::SetBox(point, box.width, box.height, box.depth, &box.upWorld.x);
  }
}

} // namespace

//------------------------------------------------------------------------------
PointLights::PointLights(vtkRenderer* renderer, const std::vector<PointedLight>& areas)
  : renderer_(renderer)
  , own_(renderer->GetLights())
  , areas_(areas)
{
  auto area = areas.begin();
  vtkCollectionSimpleIterator iterator;
  this->own_->InitTraversal(iterator);
  for (int sceneIndex = 0; vtkLight* light = this->own_->GetNextLight(iterator); ++sceneIndex)
  {
    if (area != areas.end() && area->light.sceneIndex == sceneIndex)
    {
      this->standIns_->AddItem(centreOf(light));
      ++area;
    }
    else
    {
      this->standIns_->AddItem(light);
    }
  }
  RendererAccess::lights(renderer) = this->standIns_;
}

//------------------------------------------------------------------------------
PointLights::~PointLights()
{
  RendererAccess::lights(this->renderer_) = this->own_;
  // VTK sends lights to shaders again that are newer than what these have, by the times of the lights and of their
  // collection.
  this->own_->Modified();
}

//------------------------------------------------------------------------------
void PointLights::moveTo(std::size_t point)
{
  for (const PointedLight& area : this->areas_)
  {
    place(vtkLight::SafeDownCast(this->standIns_->GetItemAsObject(area.light.sceneIndex)),
      area.light, area.offsets[point]);
  }
}

} // namespace gnomon
