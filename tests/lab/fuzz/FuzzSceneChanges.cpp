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
  void (*apply)(FuzzScene& scene, Random& random);
};

const std::vector<FuzzScene::Kind>& FuzzScene::kinds()
{
  static const std::vector<Kind> all = {
    { "camera",
      [](FuzzScene& scene, Random& random)
      {
        vtkRenderer* const renderer = pick(scene.renderers_, random);
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
            scene.placeCamera(renderer, random);
        }
      } },
    { "light's place",
      [](FuzzScene& scene, Random& random)
      {
        if (!scene.lights_.empty())
        {
          scene.placeLight(pick(scene.lights_, random), random);
        }
      } },
    { "light",
      [](FuzzScene& scene, Random& random)
      {
        if (scene.lights_.empty() || (scene.lights_.size() < 4 && chance(random, 0.2)))
        {
          scene.addLight(random);
          return;
        }
        const std::size_t number = random() % scene.lights_.size();
        vtkLight* const light = scene.lights_[number];
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
            scene.setLight(number, drawn.front().first, drawn.front().second);
            break;
          }
          case 4:
            light->SetShadowAttenuation(static_cast<float>(uniform(random, 0.0, 1.0)));
            break;
          default:
            scene.shapeLight(light, random);
        }
      } },
    { "prop's place",
      [](FuzzScene& scene, Random& random)
      {
        vtkProp3D* const prop = scene.someProp(random);
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
              2, 3, prop->GetUserMatrix()->GetElement(2, 3) + 0.2 * scene.unit_);
        }
      } },
    { "points",
      [](FuzzScene& scene, Random& random)
      {
        vtkActor* const actor = scene.someActor(random);
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
      } },
    { "data",
      [](FuzzScene& scene, Random& random)
      {
        vtkActor* const actor = scene.someActor(random);
        if (auto* const mapper =
              actor ? vtkPolyDataMapper::SafeDownCast(actor->GetMapper()) : nullptr)
        {
          actor->SetTexture(nullptr);
          mapper->SetInputData(drawSurface(random));
        }
        else if (auto* const glyphs =
                   actor ? vtkGlyph3DMapper::SafeDownCast(actor->GetMapper()) : nullptr)
        {
          glyphs->SetScaleFactor(uniform(random, 0.1, 1.0));
        }
      } },
    { "clipping planes",
      [](FuzzScene& scene, Random& random)
      {
        vtkActor* const actor = scene.someActor(random);
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
        plane->SetOrigin(0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
          0.5 * (bounds[4] + bounds[5]));
        mapper->AddClippingPlane(plane);
      } },
    { "texture",
      [](FuzzScene& scene, Random& random)
      {
        vtkActor* const actor = scene.someActor(random);
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
      } },
    { "look",
      [](FuzzScene& scene, Random& random)
      {
        if (vtkActor* const actor = scene.someActor(random))
        {
          vtkProperty* const look = actor->GetProperty();
          look->SetColor(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0), 0.5);
          look->SetOpacity(chance(random, 0.2) ? 0.5 : 1.0);
          look->SetInterpolation(static_cast<int>(random() % 3));
          look->SetRepresentation(
            chance(random, 0.9) ? VTK_SURFACE : static_cast<int>(random() % 3));
          look->SetBackfaceCulling(chance(random, 0.2));
        }
      } },
    { "prop comes or goes",
      [](FuzzScene& scene, Random& random)
      {
        if (vtkProp3D* const prop = scene.someProp(random))
        {
          for (vtkRenderer* renderer : scene.renderers_)
          {
            renderer->HasViewProp(prop) ? renderer->RemoveViewProp(prop)
                                        : renderer->AddViewProp(prop);
          }
        }
      } },
    { "visibility",
      [](FuzzScene& scene, Random& random)
      {
        if (vtkProp3D* const prop = scene.someProp(random))
        {
          prop->SetVisibility(!prop->GetVisibility());
        }
      } },
    { "level of detail",
      [](FuzzScene& scene, Random& random)
      {
        if (auto* const levels = vtkLODProp3D::SafeDownCast(scene.someProp(random)))
        {
          levels->SetSelectedLODID(levels->GetCurrentIndex() - 1 - static_cast<int>(random() % 2));
        }
      } },
    { "window's size", [](FuzzScene& scene, Random& random) { scene.sizeWindow(random); } },
    { "stereo eye",
      [](FuzzScene& scene, Random& random)
      {
        const std::array<int, 3> types{ VTK_STEREO_LEFT, VTK_STEREO_RIGHT, VTK_STEREO_ANAGLYPH };
        const std::size_t choice = random() % 4;
        scene.window_->SetStereoRender(choice < types.size());
        if (choice < types.size())
        {
          scene.window_->SetStereoType(types[choice]);
        }
        // VTK 9.1 draws the first frame in stereo with the matrices of the frame before it.
        for (vtkRenderer* renderer : scene.renderers_)
        {
          renderer->GetActiveCamera()->Modified();
        }
      } },
    { "pass's renderers",
      [](FuzzScene& scene, Random& random)
      {
        const std::size_t only = random() % (scene.renderers_.size() + 1); // the size: both
        for (std::size_t i = 0; i < scene.renderers_.size(); ++i)
        {
          scene.renderers_[i]->SetPass(
            only == i || only == scene.renderers_.size() ? scene.pass_.Get() : nullptr);
        }
      } },
    { "technique", [](FuzzScene& scene, Random& random) { scene.set(drawSettings(random)); } },
    { "setting",
      [](FuzzScene& scene, Random& random)
      {
        const auto& [name, value] = drawSetting(scene.pass_->GetTechnique(), random);
        scene.set(name, value);
      } },
    { "prop key",
      [](FuzzScene& scene, Random& random)
      {
        vtkProp3D* const prop = scene.someProp(random);
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
      } },
    { "far prop",
      [](FuzzScene& scene, Random& random)
      {
        if (vtkProp3D* const prop = scene.someProp(random))
        {
          const double distance = pick<double>({ 0.0, 12.0, 350.0, 1e5 }, random);
          glm::dvec3 place = distance * unitVector(random);
          prop->SetPosition(glm::value_ptr(place));
        }
      } },
    { "changing prop",
      [](FuzzScene& scene, Random& random)
      {
        const test::PropChange& change = pick(test::propChanges(), random);
        if (!scene.changingProps_.empty())
        {
          change.apply(pick(scene.changingProps_, random));
          scene.description_ += std::string("  ") + change.name + "\n";
        }
      } },
  };
  return all;
}

Change drawChange(Random& random)
{
  const std::size_t kind = random() % FuzzScene::kinds().size();
  return { kind, static_cast<unsigned>(random()) };
}

void FuzzScene::apply(const Change& change)
{
  const Kind& kind = kinds().at(change.kind);
  this->description_ += std::string("change: ") + kind.name + "\n";
  Random random(change.seed);
  kind.apply(*this, random);
}

vtkProp3D* FuzzScene::someProp(Random& random) const
{
  return this->props_.empty() ? nullptr : pick(this->props_, random).Get();
}

vtkActor* FuzzScene::someActor(Random& random) const
{
  return vtkActor::SafeDownCast(this->someProp(random));
}

} // namespace gnomon::fuzz
