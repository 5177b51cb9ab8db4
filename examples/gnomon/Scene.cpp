#include "Scene.h"

#include "BuiltinScenes.h"
#include "Errors.h"
#include "Files.h"
#include "ModelFile.h"
#include "SceneFile.h"
#include "SceneFraming.h"
#include "Vec3.h"
#include "VtkMessages.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonFlatteringLights.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonPropKeys.h"

#include <vtkActor.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace gnomon::tool
{

namespace
{

Scene makeModelScene(const std::string& path, bool ground)
{
  Model model = readModelFile(path);
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  scene.models = std::move(model.surfaces);
  scene.notes = std::move(model.notes);
  scene.camera = model.camera ? *model.camera : framingCamera(scene, ground);
  if (ground)
  {
    addGround(scene);
  }
  scene.lights = std::move(model.lights);
  if (scene.lights.empty())
  {
    scene.lights = { defaultLight() };
    scene.hasDefaultLight = true;
    setAmbient(scene, defaultAmbient);
  }
  return scene;
}

vtkSmartPointer<vtkActor> makeActor(const SceneModel& model, bool isGlass)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(model.surface);
  // Readers keep scalars only if they are colours.
  mapper->SetColorModeToDirectScalars();

  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetProperty(model.property);
  actor->SetTexture(model.texture);
  if (model.translucent)
  {
    actor->ForceTranslucentOn();
  }
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(model.matrix.data());
  actor->SetUserMatrix(matrix);
  vtkGnomonPropKeys::SetCasts(actor, model.casts);
  vtkGnomonPropKeys::SetTransmits(
    actor, isGlass ? vtkGnomonPropKeys::TRANSMITS_GREY : vtkGnomonPropKeys::TRANSMITS_NOTHING);
  vtkGnomonPropKeys::SetReceives(actor, model.receives);
  vtkGnomonPropKeys::SetOneSided(actor, model.oneSided);
  return actor;
}

vtkSmartPointer<vtkLight> makeAreaLight(const SceneLight::Area& area)
{
  auto light = vtkSmartPointer<vtkGnomonAreaLight>::New();
  light->SetShape(area.rectangle ? vtkGnomonAreaLight::RECTANGLE : vtkGnomonAreaLight::DISK);
  light->SetRadius(area.radius);
  light->SetWidth(area.width);
  light->SetHeight(area.height);
  light->SetUp(area.up[0], area.up[1], area.up[2]);
  light->SetTexture(area.texture);
  return light;
}

vtkSmartPointer<vtkLight> makeLight(const SceneLight& source)
{
  const vtkSmartPointer<vtkLight> light =
    source.area ? makeAreaLight(*source.area) : vtkSmartPointer<vtkLight>::New();
  light->SetLightTypeToSceneLight();
  light->SetPosition(source.position.data());
  light->SetFocalPoint(source.target.data());
  light->SetColor(source.color.data());
  light->SetIntensity(source.intensity);
  light->SetPositional(source.type != SceneLight::Type::Directional);
  if (source.type != SceneLight::Type::Directional)
  {
    // VTK's spot lights have a cone below 90 degrees.
    constexpr double allDirections = 180.0;
    light->SetConeAngle(
      source.type == SceneLight::Type::Spot ? source.coneAngleDegrees : allDirections);
  }
  if (source.box)
  {
    vtkGnomonLightKeys::SetBox(
      light, source.box->width, source.box->height, source.box->depth, source.box->up.data());
  }
  for (const auto& [name, value] : source.settings)
  {
    vtkGnomonLightKeys::SetSetting(light, name.c_str(), value.c_str());
  }
  return light;
}

/// Fit the camera's clipping planes to the picture's contents.
void setClippingRange(vtkRenderer* renderer, const Scene& scene, double aspect)
{
  // Settings for a camera that moves later. VTK widens the range by half its length, which wastes
  // depth precision. If the eye is in the scene's box, VTK puts the near plane at a hundredth of
  // the far one. That clips the ground in front of an eye that stands on it.
  constexpr double smallestNearShare = 1e-4;
  renderer->SetClippingRangeExpansion(0.05);
  renderer->SetNearClippingPlaneTolerance(smallestNearShare);

  // A nearer near plane makes depths behind it coarser, and touching surfaces show through each
  // other along their edges. So the near plane is as far away as the scene allows.
  constexpr double margin = 0.01;
  if (!scene.props.empty())
  {
    renderer->ResetCameraClippingRange(); // asks props for their bounds
    return;
  }
  const DepthRange depths = visibleDepths(scene, aspect);
  if (depths.farthest < depths.nearest || depths.farthest == 0.0)
  {
    return; // nothing is visible
  }
  const double farPlane = (1.0 + margin) * depths.farthest;
  renderer->GetActiveCamera()->SetClippingRange(
    std::max((1.0 - margin) * depths.nearest, smallestNearShare * farPlane), farPlane);
}

} // namespace

Scene loadScene(const std::string& nameOrPath, std::optional<bool> ground)
{
  if (const BuiltinScene* builtin = findBuiltinScene(nameOrPath))
  {
    return builtin->make();
  }
  const std::string extension = lowerExtension(nameOrPath);
  if (extension == ".json")
  {
    return readSceneFile(nameOrPath, ground);
  }
  if (isModelFile(nameOrPath))
  {
    return makeModelScene(nameOrPath, ground.value_or(true));
  }
  std::error_code error;
  if (!std::filesystem::exists(nameOrPath, error))
  {
    throw BadInput(nameOrPath +
      ": no such file, and no built-in scene has this name; there are: " + builtinSceneNames());
  }
  throw BadInput(nameOrPath + ": the file type is \"" + extension +
    "\", expected .json (a scene file) or one of: " + modelFileTypes());
}

void setLights(vtkRenderer* renderer, const std::vector<SceneLight>& lights)
{
  renderer->RemoveAllLights();
  for (const SceneLight& light : lights)
  {
    renderer->AddLight(makeLight(light));
  }
}

void setCamera(vtkCamera* camera, const SceneCamera& source)
{
  camera->SetPosition(source.position.data());
  camera->SetFocalPoint(source.target.data());
  camera->SetViewUp(source.up.data());
  camera->SetViewAngle(source.fovDegrees);
  camera->SetParallelProjection(source.parallelScale.has_value());
  camera->SetParallelScale(source.parallelScale.value_or(1.0));
}

void placeDefaultLight(Scene& scene, double aspect)
{
  if (!scene.hasDefaultLight)
  {
    return;
  }
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(scene, aspect);
  const auto window = makeOffScreenWindow(); // has the picture's shape, and draws nothing
  window->SetSize(static_cast<int>(std::lround(1000.0 * aspect)), 1000);
  window->AddRenderer(renderer);
  vtkNew<vtkLight> key;
  vtkNew<vtkLight> fill;
  const VtkMessages messages; // models that nothing can be seen of keep the default light
  if (vtkNew<vtkGnomonFlatteringLights>()->Make(renderer, key, fill))
  {
    key->GetPosition(scene.lights.front().position.data());
    key->GetFocalPoint(scene.lights.front().target.data());
  }
}

vtkSmartPointer<vtkRenderer> makeRenderer(const Scene& scene, double aspect)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(scene.background[0], scene.background[1], scene.background[2]);
  for (const SceneModel& model : scene.models)
  {
    renderer->AddActor(makeActor(model, scene.isGlass));
  }
  for (const SceneProp& prop : scene.props)
  {
    renderer->AddViewProp(prop.make());
  }
  renderer->AutomaticLightCreationOff();
  setLights(renderer, scene.lights);

  vtkNew<vtkCamera> camera;
  setCamera(camera, scene.camera);
  renderer->SetActiveCamera(camera);

  setClippingRange(renderer, scene, aspect);
  return renderer;
}

} // namespace gnomon::tool
