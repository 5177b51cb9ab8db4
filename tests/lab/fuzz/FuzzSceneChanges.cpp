#include "FuzzScene.h"

#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonPropKeys.h"

#include <vtkCamera.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkLODProp3D.h>
#include <vtkMapper.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <glm/gtc/type_ptr.hpp>

#include <array>

namespace gnomon::fuzz
{

using test::uniform;
using test::unitVector;

/// A kind of change.
struct FuzzScene::Kind
{
  const char* name;
  void (FuzzScene::*apply)(Random& random);
};

//------------------------------------------------------------------------------
const std::vector<FuzzScene::Kind>& FuzzScene::kinds()
{
  static const std::vector<Kind> all = { { "camera", &FuzzScene::moveCamera },
    { "light's place", &FuzzScene::moveLight }, { "light", &FuzzScene::changeLight },
    { "prop's place", &FuzzScene::moveProp }, { "points", &FuzzScene::editPoints },
    { "data", &FuzzScene::replaceData }, { "clipping planes", &FuzzScene::clip },
    { "texture", &FuzzScene::changeTexture }, { "look", &FuzzScene::changeLook },
    { "prop comes or goes", &FuzzScene::toggleProp },
    { "visibility", &FuzzScene::toggleVisibility }, { "level of detail", &FuzzScene::chooseLevel },
    { "window's size", &FuzzScene::sizeWindow }, { "stereo eye", &FuzzScene::chooseStereo },
    { "pass's renderers", &FuzzScene::chooseRenderer },
    { "technique", &FuzzScene::chooseTechnique }, { "setting", &FuzzScene::changeSetting },
    { "prop key", &FuzzScene::setPropKey }, { "far prop", &FuzzScene::sendFarProp },
    { "changing prop", &FuzzScene::changeProp }, { "changing prop", &FuzzScene::changeProp } };
  return all;
}

//------------------------------------------------------------------------------
Change drawChange(Random& random)
{
  const std::size_t kind = random() % FuzzScene::kinds().size();
  return { kind, static_cast<unsigned>(random()) };
}

//------------------------------------------------------------------------------
void FuzzScene::apply(const Change& change)
{
  const Kind& kind = kinds().at(change.kind);
  this->description_ += std::string("change: ") + kind.name + "\n";
  Random random(change.seed);
  (this->*kind.apply)(random);
}

//------------------------------------------------------------------------------
vtkProp3D* FuzzScene::someProp(Random& random) const
{
  return this->props_.empty() ? nullptr : pick(this->props_, random).Get();
}

//------------------------------------------------------------------------------
vtkActor* FuzzScene::someActor(Random& random) const
{
  return vtkActor::SafeDownCast(this->someProp(random));
}

//------------------------------------------------------------------------------
void FuzzScene::moveCamera(Random& random)
{
  vtkRenderer* const renderer = pick(this->renderers_, random);
  vtkCamera* const camera = renderer->GetActiveCamera();
  switch (random() % 4)
  {
    case 0:
      camera->Azimuth(uniform(random, -30.0, 30.0));
      break;
    case 1:
      camera->Dolly(uniform(random, 0.8, 1.2));
      break;
    case 2:
      camera->SetParallelProjection(!camera->GetParallelProjection());
      break;
    default:
      this->placeCamera(renderer, random);
  }
}

//------------------------------------------------------------------------------
void FuzzScene::moveLight(Random& random)
{
  if (!this->lights_.empty())
  {
    this->placeLight(pick(this->lights_, random), random);
  }
}

//------------------------------------------------------------------------------
void FuzzScene::changeLight(Random& random)
{
  if (this->lights_.empty() || (this->lights_.size() < 4 && chance(random, 0.2)))
  {
    this->addLight(random);
    return;
  }
  const std::size_t number = random() % this->lights_.size();
  vtkLight* const light = this->lights_[number];
  switch (random() % 6)
  {
    case 0:
      light->SetSwitch(!light->GetSwitch());
      break;
    case 1:
      light->SetDiffuseColor(1.0, uniform(random, 0.0, 1.0), 0.5);
      break;
    case 2:
      vtkGnomonLightKeys::SetCasts(light, random() % 2 == 0);
      break;
    case 3:
    {
      const NamedSettings drawn = drawSettings(random);
      this->setLight(number, drawn.front().first, drawn.front().second);
      break;
    }
    case 4:
      light->SetShadowAttenuation(static_cast<float>(uniform(random, 0.0, 1.0)));
      break;
    default:
      this->shapeLight(light, random);
  }
}

//------------------------------------------------------------------------------
void FuzzScene::moveProp(Random& random)
{
  vtkProp3D* const prop = this->someProp(random);
  if (!prop)
  {
    return;
  }
  switch (random() % 4)
  {
    case 0:
      prop->AddPosition(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), 0.0);
      break;
    case 1:
      prop->RotateZ(uniform(random, 0.0, 90.0));
      break;
    case 2:
      prop->SetScale(chance(random, 0.5) ? -1.0 : 1.0, 1.0, uniform(random, 0.2, 1.5));
      break;
    default:
      prop->GetUserMatrix()->SetElement(
        2, 3, prop->GetUserMatrix()->GetElement(2, 3) + 0.2 * this->unit_);
  }
}

//------------------------------------------------------------------------------
void FuzzScene::changeProp(Random& random)
{
  const test::PropChange& change = pick(test::propChanges(), random);
  if (!this->changingProps_.empty())
  {
    change.apply(pick(this->changingProps_, random));
    this->description_ += std::string("  ") + change.name + "\n";
  }
}

//------------------------------------------------------------------------------
void FuzzScene::editPoints(Random& random)
{
  vtkActor* const actor = this->someActor(random);
  auto* const mapper = actor ? vtkPolyDataMapper::SafeDownCast(actor->GetMapper()) : nullptr;
  vtkPoints* const points = mapper ? mapper->GetInput()->GetPoints() : nullptr;
  if (!points || points->GetNumberOfPoints() == 0)
  {
    return;
  }
  const vtkIdType point = random() % points->GetNumberOfPoints();
  glm::dvec3 position;
  points->GetPoint(point, glm::value_ptr(position));
  position += 0.3 * unitVector(random);
  points->SetPoint(point, glm::value_ptr(position));
  points->Modified();
}

//------------------------------------------------------------------------------
void FuzzScene::replaceData(Random& random)
{
  vtkActor* const actor = this->someActor(random);
  if (auto* const mapper = actor ? vtkPolyDataMapper::SafeDownCast(actor->GetMapper()) : nullptr)
  {
    actor->SetTexture(nullptr);
    mapper->SetInputData(drawSurface(random));
  }
  else if (auto* const glyphs =
             actor ? vtkGlyph3DMapper::SafeDownCast(actor->GetMapper()) : nullptr)
  {
    glyphs->SetScaleFactor(uniform(random, 0.1, 1.0));
  }
}

//------------------------------------------------------------------------------
void FuzzScene::clip(Random& random)
{
  vtkActor* const actor = this->someActor(random);
  if (!actor)
  {
    return;
  }
  vtkMapper* const mapper = actor->GetMapper();
  vtkPlaneCollection* const planes = mapper->GetClippingPlanes();
  if (planes && planes->GetNumberOfItems() > 0 && random() % 3 == 0)
  {
    mapper->RemoveAllClippingPlanes();
    return;
  }
  if (planes && planes->GetNumberOfItems() > 1)
  {
    planes->GetItem(0)->SetNormal(glm::value_ptr(unitVector(random)));
    return;
  }
  const double* const bounds = actor->GetBounds();
  vtkNew<vtkPlane> plane;
  plane->SetNormal(glm::value_ptr(unitVector(random)));
  plane->SetOrigin(
    0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]), 0.5 * (bounds[4] + bounds[5]));
  mapper->AddClippingPlane(plane);
}

//------------------------------------------------------------------------------
void FuzzScene::changeTexture(Random& random)
{
  vtkActor* const actor = this->someActor(random);
  auto* const mapper = actor ? vtkPolyDataMapper::SafeDownCast(actor->GetMapper()) : nullptr;
  if (!mapper || !mapper->GetInput()->GetPointData()->GetTCoords())
  {
    return;
  }
  vtkTexture* const texture = actor->GetTexture();
  switch (texture ? random() % 3 : 0)
  {
    case 0:
      actor->SetTexture(texture ? nullptr : drawHoles(random).Get());
      actor->ForceOpaqueOn();
      // VTK 9.1 keeps drawing with the shader that samples the texture.
      mapper->Modified();
      break;
    case 1:
      texture->SetInterpolate(!texture->GetInterpolate());
      break;
    default:
      texture->GetInput()->SetScalarComponentFromDouble(0, 0, 0, 3, random() % 2 * 255.0);
      texture->GetInput()->Modified();
  }
}

//------------------------------------------------------------------------------
void FuzzScene::changeLook(Random& random)
{
  if (vtkActor* const actor = this->someActor(random))
  {
    vtkProperty* const look = actor->GetProperty();
    look->SetColor(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0), 0.5);
    look->SetOpacity(chance(random, 0.2) ? 0.5 : 1.0);
    look->SetInterpolation(static_cast<int>(random() % 3));
    look->SetRepresentation(chance(random, 0.9) ? VTK_SURFACE : static_cast<int>(random() % 3));
    look->SetBackfaceCulling(chance(random, 0.2));
  }
}

//------------------------------------------------------------------------------
void FuzzScene::toggleProp(Random& random)
{
  if (vtkProp3D* const prop = this->someProp(random))
  {
    for (vtkRenderer* renderer : this->renderers_)
    {
      renderer->HasViewProp(prop) ? renderer->RemoveViewProp(prop) : renderer->AddViewProp(prop);
    }
  }
}

//------------------------------------------------------------------------------
void FuzzScene::toggleVisibility(Random& random)
{
  if (vtkProp3D* const prop = this->someProp(random))
  {
    prop->SetVisibility(!prop->GetVisibility());
  }
}

//------------------------------------------------------------------------------
void FuzzScene::chooseLevel(Random& random)
{
  if (auto* const levels = vtkLODProp3D::SafeDownCast(this->someProp(random)))
  {
    levels->SetSelectedLODID(levels->GetCurrentIndex() - 1 - static_cast<int>(random() % 2));
  }
}

//------------------------------------------------------------------------------
void FuzzScene::chooseStereo(Random& random)
{
  const std::array<int, 3> types{ VTK_STEREO_LEFT, VTK_STEREO_RIGHT, VTK_STEREO_ANAGLYPH };
  const std::size_t choice = random() % 4;
  this->window_->SetStereoRender(choice < types.size());
  if (choice < types.size())
  {
    this->window_->SetStereoType(types[choice]);
  }
  // VTK 9.1 draws the first frame in stereo with the matrices of the frame before it.
  for (vtkRenderer* renderer : this->renderers_)
  {
    renderer->GetActiveCamera()->Modified();
  }
}

//------------------------------------------------------------------------------
void FuzzScene::chooseRenderer(Random& random)
{
  const std::size_t only = random() % (this->renderers_.size() + 1); // the size: both
  for (std::size_t i = 0; i < this->renderers_.size(); ++i)
  {
    this->renderers_[i]->SetPass(
      only == i || only == this->renderers_.size() ? this->pass_.Get() : nullptr);
  }
}

//------------------------------------------------------------------------------
void FuzzScene::chooseTechnique(Random& random)
{
  this->set(drawSettings(random));
}

//------------------------------------------------------------------------------
void FuzzScene::changeSetting(Random& random)
{
  const auto& [name, value] = drawSetting(this->pass_->GetTechnique(), random);
  this->set(name, value);
}

//------------------------------------------------------------------------------
void FuzzScene::setPropKey(Random& random)
{
  vtkProp3D* const prop = this->someProp(random);
  const bool on = random() % 2 == 0;
  if (!prop)
  {
    return;
  }
  switch (random() % 3)
  {
    case 0:
      vtkGnomonPropKeys::SetCasts(prop, on);
      break;
    case 1:
      vtkGnomonPropKeys::SetReceives(prop, on);
      break;
    default:
      vtkGnomonPropKeys::SetOneSided(prop, on);
  }
}

//------------------------------------------------------------------------------
void FuzzScene::sendFarProp(Random& random)
{
  if (vtkProp3D* const prop = this->someProp(random))
  {
    const double distance = pick<double>({ 0.0, 12.0, 350.0, 1e5 }, random);
    glm::dvec3 place = distance * unitVector(random);
    prop->SetPosition(glm::value_ptr(place));
  }
}

} // namespace gnomon::fuzz
