#include "AreaLights.h"

namespace gnomon::test
{
namespace
{

const glm::dvec3 lampPlace(-2.0, -2.5, 6.0);
const glm::dvec3 middle(0.0);

/// Two rows of grey, red and dark, and of blue, white and black. No mean of them equals the
/// middle's colour.
vtkSmartPointer<vtkImageData> makePanes()
{
  const glm::dvec3 panes[2][3] = { { { 0.35, 0.35, 0.35 }, { 1.0, 0.08, 0.04 },
                                     { 0.05, 0.1, 0.04 } },
    { { 0.04, 0.2, 1.0 }, glm::dvec3(1.0), glm::dvec3(0.0) } };
  return makeImage(3, 2, [&](int x, int y) { return panes[y][x]; });
}

/// Give a light a texture. It is so dim that no point's picture is clipped.
template <typename Light>
Light* textured(Light* light)
{
  light->SetIntensity(0.5);
  light->SetTexture(makePanes());
  return light;
}

vtkLight* addSoftSunInABox(PassScene& scene)
{
  // The near face cuts the sphere and the box.
  vtkLight* light = addSoftSun(scene, { 0.4, 0.5, -1.0 }, "8");
  const double up[3] = { 0.3, 1.0, 0.0 };
  light->SetPosition(-0.2, -0.25, 0.5);
  vtkGnomonLightKeys::SetBox(light, 5.0, 4.0, 8.0, up);
  return light;
}

vtkLight* addFading(PassScene& scene)
{
  vtkGnomonAreaLight* light = addRectangle(scene, lampPlace, middle, 1.0, 50.0);
  light->SetExponent(4.0);
  light->SetAttenuationValues(0.2, 0.1, 0.02);
  light->SetDiffuseColor(1.0, 0.8, 0.5);
  light->SetSpecularColor(0.3, 0.6, 1.0);
  light->SetAmbientColor(0.1, 0.1, 0.2);
  return light;
}

vtkLight* addPlacedByAMatrix(PassScene& scene)
{
  vtkGnomonAreaLight* light = addRectangle(scene, lampPlace, middle, 1.5, 60.0);
  vtkNew<vtkTransform> transform;
  transform->RotateZ(25.0);
  transform->Translate(0.3, 0.2, 0.1);
  light->SetTransformMatrix(transform->GetMatrix());
  return light;
}

vtkLight* addWindow(PassScene& scene)
{
  vtkGnomonAreaLight* light = textured(addRectangle(scene, lampPlace, middle, 2.0, 60.0));
  light->SetDiffuseColor(1.0, 0.8, 0.9);
  light->SetSpecularColor(0.5, 1.0, 0.7);
  return light;
}

vtkLight* addWindowOfTheSky(PassScene& scene)
{
  vtkGnomonAreaLight* light =
    textured(addRectangle(scene, lampPlace, middle, 24.0, 90.0)); // degrees
  light->PositionalOff();
  return light;
}

vtkLight* addHeadlight(PassScene& scene)
{
  vtkLight* light = addSoftSun(scene, { 0.0, 0.0, -1.0 }, "20");
  light->SetLightTypeToHeadlight();
  vtkGnomonLightKeys::SetCasts(light, true); // a headlight that is alone needs the key
  return light;
}

vtkLight* addCameraLight(PassScene& scene)
{
  vtkGnomonAreaLight* light = addRectangle(scene, { 0.2, 0.3, 1.0 }, middle, 2.0, 80.0);
  light->SetLightTypeToCameraLight();
  return light;
}

} // namespace

const std::vector<AreaLight>& areaLights()
{
  constexpr bool isTextured = true;
  constexpr bool followsCamera = true;
  static const std::vector<AreaLight> lights = {
    { "sun",
      [](PassScene& scene) {
        return addSoftSun(scene, { 0.4, 0.5, -1.0 }, "8");
      } },
    { "sunInABox", addSoftSunInABox },
    { "rectangle",
      [](PassScene& scene) { return addRectangle(scene, lampPlace, middle, 1.5, 50.0); } },
    { "wideRectangle",
      [](PassScene& scene) { return addRectangle(scene, lampPlace, middle, 1.5, 75.0); } },
    { "disk", [](PassScene& scene) { return addDisk(scene, lampPlace, middle, 0.5, 50.0); } },
    { "pointedDisk",
      [](PassScene& scene) { return addDisk(scene, lampPlace, middle, 0.5, allDirections); } },
    { "ball", [](PassScene& scene) { return addBall(scene, lampPlace, "0.5"); } },
    { "fading", addFading },
    { "placedByAMatrix", addPlacedByAMatrix },
    { "window", addWindow, isTextured },
    { "roundWindow",
      [](PassScene& scene) { return textured(addDisk(scene, lampPlace, middle, 1.2, 70.0)); },
      isTextured },
    { "windowOfTheSky", addWindowOfTheSky, isTextured },
    { "headlight", addHeadlight, !isTextured, followsCamera },
    { "cameraLight", addCameraLight, !isTextured, followsCamera },
  };
  return lights;
}

std::vector<AreaLight> plainAreaLights()
{
  std::vector<AreaLight> lights;
  std::copy_if(areaLights().begin(), areaLights().end(), std::back_inserter(lights),
    [](const AreaLight& light) { return !light.isTextured && !light.followsCamera; });
  return lights;
}

vtkGnomonAreaLight* addRectangle(PassScene& scene, const glm::dvec3& position,
  const glm::dvec3& target, double width, double coneAngleDegrees)
{
  vtkGnomonAreaLight* light = addDisk(scene, position, target, 0.5, coneAngleDegrees);
  light->SetShapeToRectangle();
  light->SetWidth(width);
  light->SetHeight(0.6 * width);
  return light;
}

vtkGnomonAreaLight* addDisk(PassScene& scene, const glm::dvec3& position, const glm::dvec3& target,
  double radius, double coneAngleDegrees)
{
  vtkNew<vtkGnomonAreaLight> light;
  aim(light, position, target);
  light->SetConeAngle(coneAngleDegrees);
  light->SetExponent(0.0);
  light->SetShapeToDisk();
  light->SetRadius(radius);
  scene.renderer->AddLight(light);
  return light;
}

vtkLight* addBall(PassScene& scene, const glm::dvec3& position, const char* radius)
{
  vtkLight* light = scene.addSpot(position, { position.x, position.y, 0.0 }, allDirections);
  set(light, "light_radius", radius);
  return light;
}

vtkLight* addSoftSun(PassScene& scene, const glm::dvec3& direction, const char* degrees)
{
  vtkLight* light = scene.addSun(direction);
  set(light, "light_radius", degrees);
  return light;
}

void scaleArea(vtkLight* light, double factor)
{
  if (auto* area = vtkGnomonAreaLight::SafeDownCast(light))
  {
    area->SetRadius(factor * area->GetRadius());
    area->SetWidth(factor * area->GetWidth());
    area->SetHeight(factor * area->GetHeight());
    return;
  }
  const double size = std::stod(vtkGnomonLightKeys::GetSetting(light, "light_radius"));
  set(light, "light_radius", std::to_string(factor * size).c_str());
}

HalfPlaneScene::HalfPlaneScene(int width, int height, double halfHeight)
  : PassScene(width, height)
{
  this->addFloor(20.0)->SetScale(1.0, 0.2, 1.0); // texels are five times as long along x
  this->addBox({ -12.0, -4.0, edgeHeight - 0.001 }, { 0.0, 4.0, edgeHeight });
  this->lookDown(halfHeight, 0.0, 0.0, 1.5);
}

double widthOf(const std::vector<double>& profile)
{
  const auto passes = [&](double level)
  {
    const auto above =
      std::find_if(profile.begin() + 1, profile.end(), [&](double v) { return v >= level; });
    EXPECT_NE(above, profile.end());
    const double before = *(above - 1);
    return static_cast<double>(above - profile.begin()) - (*above - level) / (*above - before);
  };
  return passes(0.9) - passes(0.1);
}

Hints hintsOf(const VisibilityImages& kept, const std::vector<float>& truth)
{
  Hints hints;
  double decided = 0.0;
  const ClassImage& classes = kept.classes.at(0);
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const std::string& of = classes.classes[classes.ofPixels[i]].name;
    const bool traced = of.find("traced") != std::string::npos;
    const bool hinted = of.find("hinted") != std::string::npos;
    const float visibility = kept.visibility[0][i];
    decided += traced || hinted ? 1.0 : 0.0;
    hints.traced += traced ? 1.0 : 0.0;
    hints.wrong += hinted && visibility != truth[i] ? 1.0 : 0.0;
    hints.worst = std::max(hints.worst, hinted ? std::abs(double(visibility) - truth[i]) : 0.0);
    EXPECT_EQ(visibility, hinted ? (of == "hinted lit" ? 1.0f : 0.0f) : truth[i]) << of;
  }
  hints.traced /= decided;
  hints.wrong /= decided;
  return hints;
}

} // namespace gnomon::test
