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
#include <functional>
#include <initializer_list>

namespace gnomon::fuzz
{

using test::uniform;
using test::unitVector;

/// A kind of change.
struct FuzzScene::Kind
{
  const char* name;
  std::function<void(FuzzScene& scene, Random& random)> apply;
};

namespace
{

/// Do one of several things.
void doOne(Random& random, std::initializer_list<std::function<void()>> things)
{
  things.begin()[random() % things.size()]();
}

} // namespace

const std::vector<FuzzScene::Kind>& FuzzScene::kinds()
{
  // Changes of a random prop or actor, if there is one.
  const auto ofProp = [](void (*apply)(FuzzScene&, Random&, vtkProp3D*))
  {
    return [apply](FuzzScene& scene, Random& random)
    {
      if (vtkProp3D* const prop = scene.someProp(random))
      {
        apply(scene, random, prop);
      }
    };
  };
  const auto ofActor = [](void (*apply)(Random&, vtkActor*, vtkPolyDataMapper * ofPolyData))
  {
    return [apply](FuzzScene& scene, Random& random)
    {
      if (vtkActor* const actor = vtkActor::SafeDownCast(scene.someProp(random)))
      {
        apply(random, actor, vtkPolyDataMapper::SafeDownCast(actor->GetMapper()));
      }
    };
  };
  static const std::vector<Kind> all = {
    { "camera",
      [](FuzzScene& scene, Random& random)
      {
        vtkRenderer* const renderer = pick(scene.renderers_, random);
        vtkCamera* const camera = renderer->GetActiveCamera();
        doOne(random,
          { [&] { camera->Azimuth(uniform(random, -30.0, 30.0)); },
            [&] { camera->Dolly(uniform(random, 0.8, 1.2)); },
            [&] { camera->SetParallelProjection(!camera->GetParallelProjection()); },
            [&] { scene.placeCamera(renderer, random); } });
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
        doOne(random,
          { [&] { light->SetSwitch(!light->GetSwitch()); },
            [&] { light->SetDiffuseColor(1.0, uniform(random, 0.0, 1.0), 0.5); },
            [&] { vtkGnomonLightKeys::SetCasts(light, random() % 2 == 0); },
            [&]
            {
              const auto [name, value] = drawSettings(random).front();
              scene.setLight(number, name, value);
            },
            [&] { light->SetShadowAttenuation(static_cast<float>(uniform(random, 0.0, 1.0))); },
            [&] { scene.shapeLight(light, random); } });
      } },
    { "prop's place",
      ofProp(
        [](FuzzScene& scene, Random& random, vtkProp3D* prop)
        {
          vtkMatrix4x4* const matrix = prop->GetUserMatrix();
          doOne(random,
            { [&]
              { prop->AddPosition(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), 0.0); },
              [&] { prop->RotateZ(uniform(random, 0.0, 90.0)); },
              [&]
              { prop->SetScale(chance(random, 0.5) ? -1.0 : 1.0, 1.0, uniform(random, 0.2, 1.5)); },
              [&] { matrix->SetElement(2, 3, matrix->GetElement(2, 3) + 0.2 * scene.unit_); } });
        }) },
    { "points",
      ofActor(
        [](Random& random, vtkActor*, vtkPolyDataMapper* mapper)
        {
          vtkPoints* const points = mapper ? mapper->GetInput()->GetPoints() : nullptr;
          if (points && points->GetNumberOfPoints() > 0)
          {
            const vtkIdType point = random() % points->GetNumberOfPoints();
            glm::dvec3 position;
            points->GetPoint(point, glm::value_ptr(position));
            position += 0.3 * unitVector(random);
            points->SetPoint(point, glm::value_ptr(position));
            points->Modified();
          }
        }) },
    { "data",
      ofActor(
        [](Random& random, vtkActor* actor, vtkPolyDataMapper* mapper)
        {
          if (mapper)
          {
            actor->SetTexture(nullptr);
            mapper->SetInputData(drawSurface(random));
          }
          else if (auto* const glyphs = vtkGlyph3DMapper::SafeDownCast(actor->GetMapper()))
          {
            glyphs->SetScaleFactor(uniform(random, 0.1, 1.0));
          }
        }) },
    { "clipping planes",
      ofActor(
        [](Random& random, vtkActor* actor, vtkPolyDataMapper*)
        {
          vtkMapper* const mapper = actor->GetMapper();
          vtkPlaneCollection* const planes = mapper->GetClippingPlanes();
          const int count = planes ? planes->GetNumberOfItems() : 0;
          if (count > 0 && random() % 3 == 0)
          {
            mapper->RemoveAllClippingPlanes();
          }
          else if (count > 1)
          {
            planes->GetItem(0)->SetNormal(glm::value_ptr(unitVector(random)));
          }
          else
          {
            vtkNew<vtkPlane> plane;
            plane->SetNormal(glm::value_ptr(unitVector(random)));
            plane->SetOrigin(actor->GetCenter());
            mapper->AddClippingPlane(plane);
          }
        }) },
    { "texture",
      ofActor(
        [](Random& random, vtkActor* actor, vtkPolyDataMapper* mapper)
        {
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
        }) },
    { "look",
      ofActor(
        [](Random& random, vtkActor* actor, vtkPolyDataMapper*)
        {
          vtkProperty* const look = actor->GetProperty();
          look->SetColor(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0), 0.5);
          look->SetOpacity(chance(random, 0.2) ? 0.5 : 1.0);
          look->SetInterpolation(static_cast<int>(random() % 3));
          look->SetRepresentation(
            chance(random, 0.9) ? VTK_SURFACE : static_cast<int>(random() % 3));
          look->SetBackfaceCulling(chance(random, 0.2));
        }) },
    { "prop comes or goes",
      ofProp(
        [](FuzzScene& scene, Random&, vtkProp3D* prop)
        {
          for (vtkRenderer* renderer : scene.renderers_)
          {
            renderer->HasViewProp(prop) ? renderer->RemoveViewProp(prop)
                                        : renderer->AddViewProp(prop);
          }
        }) },
    { "visibility",
      ofProp([](FuzzScene&, Random&, vtkProp3D* prop)
        { prop->SetVisibility(!prop->GetVisibility()); }) },
    { "level of detail",
      ofProp(
        [](FuzzScene&, Random& random, vtkProp3D* prop)
        {
          if (auto* const levels = vtkLODProp3D::SafeDownCast(prop))
          {
            levels->SetSelectedLODID(
              levels->GetCurrentIndex() - 1 - static_cast<int>(random() % 2));
          }
        }) },
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
      ofProp(
        [](FuzzScene&, Random& random, vtkProp3D* prop)
        {
          const bool on = random() % 2 == 0;
          doOne(random,
            { [&] { vtkGnomonPropKeys::SetCasts(prop, on); },
              [&] { vtkGnomonPropKeys::SetReceives(prop, on); },
              [&] { vtkGnomonPropKeys::SetOneSided(prop, on); } });
        }) },
    { "far prop",
      ofProp(
        [](FuzzScene&, Random& random, vtkProp3D* prop)
        {
          const double distance = pick<double>({ 0.0, 12.0, 350.0, 1e5 }, random);
          glm::dvec3 place = distance * unitVector(random);
          prop->SetPosition(glm::value_ptr(place));
        }) },
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

} // namespace gnomon::fuzz
