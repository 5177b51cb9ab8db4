#include "plugin/pass/PointLights.h"

#include "lights/LightManager.h"
#include "lights/LightSamples.h"
#include "lights/vtkGnomonLightKeys.h"

#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <glm/gtc/type_ptr.hpp>

#include <utility>

namespace gnomon
{
namespace
{

/// Naming the member through a subclass gives access to it. The renderer's own function would
/// notify all observers of a change.
struct RendererAccess : vtkRenderer
{
  static vtkLightCollection*& lights(vtkRenderer* renderer)
  {
    return renderer->*(&RendererAccess::Lights);
  }
};

/// Replaces black: shadow passes leave out black lights and rebuild their shaders for that. A light
/// of this strength is invisible.
constexpr double leastShine = 1e-9;

/// Set a point's colour to its light's, times a factor for each channel.
void colour(vtkLight* point, vtkLight* light, const glm::dvec3& shine)
{
  const glm::dvec3 shown = glm::max(shine, leastShine);
  const glm::dvec3 diffuse = glm::make_vec3(light->GetDiffuseColor()) * shown;
  const glm::dvec3 specular = glm::make_vec3(light->GetSpecularColor()) * shown;
  point->SetDiffuseColor(diffuse.x, diffuse.y, diffuse.z);
  point->SetSpecularColor(specular.x, specular.y, specular.z);
}

/// Return a copy of the light without area, at its centre.
vtkSmartPointer<vtkLight> centreOf(vtkLight* light, const ShiningPoint& point)
{
  auto centre = vtkSmartPointer<vtkLight>::New();
  centre->DeepCopy(light);
  LightManager::makePoint(centre);
  colour(centre, light, point.shine);
  return centre;
}

/// Place a light in world coordinates.
void place(vtkLight* point, const ShadowLight& light, const glm::dvec3& offset)
{
  point->SetTransformMatrix(nullptr);
  point->SetLightTypeToSceneLight();
  const bool positional = light.kind != LightKind::Directional;
  const glm::dvec3 position = positional ? light.positionWorld + offset : light.positionWorld;
  // The area of a directional light lies at distance 1 from the point it lights.
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

PointedLight pointedLight(ShadowLight light)
{
  PointedLight pointed;
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& offset : pairedLightSamples(light))
  {
    const glm::dvec3 shine = light.texture
      ? glm::dvec3(light.texture->colourAt(offset)) / static_cast<double>(LightTexture::full)
      : glm::dvec3(1.0);
    pointed.points.push_back({ offset, shine });
    sum += shine;
  }
  if (light.texture)
  {
    pointed.centre.shine = light.texture->mean;
    const glm::dvec3 wanted = pointed.centre.shine * static_cast<double>(pointed.points.size());
    // If no point has the channel, there is nothing to scale.
    const glm::dvec3 scale =
      wanted / glm::mix(sum, glm::dvec3(1.0), glm::equal(sum, glm::dvec3(0.0)));
    for (ShiningPoint& point : pointed.points)
    {
      point.shine *= scale;
    }
  }
  pointed.light = std::move(light);
  return pointed;
}

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
      this->standIns_->AddItem(centreOf(light, area->centre));
      ++area;
    }
    else
    {
      this->standIns_->AddItem(light);
    }
  }
  RendererAccess::lights(renderer) = this->standIns_;
}

PointLights::~PointLights()
{
  RendererAccess::lights(this->renderer_) = this->own_;
  // VTK sends lights to a shader if their times, or their collection's time, are newer than the
  // shader's.
  this->own_->Modified();
}

void PointLights::moveTo(std::size_t point)
{
  for (const PointedLight& area : this->areas_)
  {
    const int index = area.light.sceneIndex;
    auto* standIn = vtkLight::SafeDownCast(this->standIns_->GetItemAsObject(index));
    place(standIn, area.light, area.points[point].offset);
    colour(standIn, vtkLight::SafeDownCast(this->own_->GetItemAsObject(index)),
      area.points[point].shine);
  }
}

} // namespace gnomon
