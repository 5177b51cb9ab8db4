#include "FuzzScene.h"

#include "VtkMessages.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "shadowtech/base/Gl.h"

#include <glm/gtc/type_ptr.hpp>
#include <vtkCamera.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::fuzz
{
namespace
{

std::ptrdiff_t countOutside(const std::vector<float>& values, float least, float most)
{
  return std::count_if(
    values.begin(), values.end(), [=](float value) { return !(value >= least && value <= most); });
}

/// True if the frame's report states the reason of an error or warning.
bool isTold(const std::string& text, const FrameReport& report)
{
  const auto holds = [&text](const std::string& reason)
  { return !reason.empty() && text.find(reason) != std::string::npos; };
  return holds(report.routeReason) ||
    std::any_of(report.misfits.begin(), report.misfits.end(), holds) ||
    std::any_of(report.leftOut.begin(), report.leftOut.end(), holds);
}

/// Check a frame of the current OpenGL context.
/// @param messages of VTK during that frame
/// @throws Find for an error of OpenGL, and for a message of VTK that the frame's report lacks.
/// Also for visibilities outside [0, 1] and receivers that are not finite.
void checkFrame(vtkGnomonShadowPass* pass, const tool::VtkMessages& messages)
{
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
  {
    throw Find("OpenGL error " + std::to_string(error));
  }
  for (const auto* texts : { &messages.errors(), &messages.warnings() })
  {
    for (const std::string& text : *texts)
    {
      if (!isTold(text, pass->GetReport()))
      {
        throw Find("VTK says: " + text);
      }
    }
  }
  const VisibilityImages& kept = pass->GetVisibility();
  std::ptrdiff_t broken = 0;
  for (const std::vector<float>& visibility : kept.visibility)
  {
    broken += countOutside(visibility, 0.0f, 1.0f);
  }
  constexpr float most = std::numeric_limits<float>::max();
  for (const auto* plane : { &kept.positionX, &kept.positionY, &kept.positionZ, &kept.normalX,
         &kept.normalY, &kept.normalZ })
  {
    broken += countOutside(*plane, -most, most);
  }
  if (broken > 0)
  {
    throw Find(std::to_string(broken) + " numbers are no visibilities, or not finite");
  }
}

using test::uniform;
using test::unitVector;

glm::dvec3 somewhere(Random& random, double reach)
{
  const double x = uniform(random, -reach, reach);
  const double y = uniform(random, -reach, reach);
  return { x, y, uniform(random, -0.3 * reach, reach) };
}

vtkSmartPointer<vtkImageData> drawLightTexture(Random& random)
{
  const auto upTo = [&](unsigned most) { return 1 + static_cast<int>(random() % most); };
  const int height = upTo(3);
  const int width = upTo(3);
  return drawImage(random, width, height, upTo(4));
}

} // namespace

FuzzScene::FuzzScene(Random random, Purpose purpose)
  : purpose_(purpose)
{
  const int views = purpose == Purpose::Changes && chance(random, 0.3) ? 2 : 1;
  this->window_->SetMultiSamples(0);
  this->window_->StereoCapableWindowOn();
  for (int view = 0; view < views; ++view)
  {
    this->renderers_.push_back(vtkSmartPointer<vtkRenderer>::New());
    this->renderers_.back()->AutomaticLightCreationOff();
    this->renderers_.back()->SetViewport(1.0 * view / views, 0.0, (view + 1.0) / views, 1.0);
    this->renderers_.back()->SetPass(this->pass_);
    this->window_->AddRenderer(this->renderers_.back());
  }
  this->sizeWindow(random);
  this->placeWorld(random);
  this->addProps(random);
  if (this->purpose_ == Purpose::Changes)
  {
    this->addChangingProps(random);
  }
  for (vtkRenderer* renderer : this->renderers_)
  {
    this->placeCamera(renderer, random);
  }
  const std::vector<unsigned> counts{ 0, 1, 1, 1, 1, 2, 2, 3, 4 };
  for (unsigned left = pick(counts, random); left > 0; --left)
  {
    this->addLight(random);
  }
  this->choosePass(random);
}

void FuzzScene::sizeWindow(Random& random)
{
  const auto side = [&] { return 1 + static_cast<int>(random() % (chance(random, 0.1) ? 8 : 96)); };
  const int width = std::max(side(), static_cast<int>(this->renderers_.size()));
  this->window_->SetSize(width, side());
}

void FuzzScene::placeWorld(Random& random)
{
  this->unit_ = chance(random, 0.3) ? std::pow(10.0, uniform(random, -4.0, 4.0)) : 1.0;
  const double away = chance(random, 0.2) ? std::pow(10.0, uniform(random, 0.0, 6.0)) : 0.0;
  const glm::dvec3 offset = this->unit_ * away * unitVector(random);
  for (int axis = 0; axis < 3; ++axis)
  {
    this->world_->SetElement(axis, axis, this->unit_);
    this->world_->SetElement(axis, 3, offset[axis]);
  }
  this->description_ +=
    "unit " + std::to_string(this->unit_) + ", away by " + std::to_string(away) + " units\n";
}

glm::dvec3 FuzzScene::inWorld(const glm::dvec3& point) const
{
  return this->unit_ * point +
    glm::dvec3(this->world_->GetElement(0, 3), this->world_->GetElement(1, 3),
      this->world_->GetElement(2, 3));
}

void FuzzScene::addProps(Random& random)
{
  std::string kinds;
  for (unsigned left = random() % 5; left > 0; --left)
  {
    const RandomProps drawn = drawProps(random);
    kinds += (kinds.empty() ? "" : ", ") + drawn.kind;
    for (const vtkSmartPointer<vtkProp3D>& prop : drawn.props)
    {
      vtkNew<vtkMatrix4x4> matrix;
      matrix->DeepCopy(this->world_);
      if (prop->GetUserMatrix())
      {
        vtkMatrix4x4::Multiply4x4(this->world_, prop->GetUserMatrix(), matrix);
      }
      prop->SetUserMatrix(matrix);
      if (chance(random, 0.1))
      {
        prop->SetScale(chance(random, 0.5) ? -1.0 : 1.0, 1.0, uniform(random, 0.1, 2.0));
      }
      vtkActor* const actor = vtkActor::SafeDownCast(prop);
      if (actor && chance(random, 0.1))
      {
        actor->GetProperty()->SetBackfaceCulling(random() % 2 == 0);
        actor->GetProperty()->SetFrontfaceCulling(random() % 4 == 0);
        vtkGnomonPropKeys::SetOneSided(actor, random() % 2 == 0);
      }
      this->props_.push_back(prop);
      for (vtkRenderer* renderer : this->renderers_)
      {
        renderer->AddViewProp(prop);
      }
    }
  }
  this->description_ += "props: " + kinds + "\n";
}

/// Add props that hide others and mostly have no surface that casts or receives.
void FuzzScene::addChangingProps(Random& random)
{
  for (unsigned left = random() % 3; left > 0; --left)
  {
    const test::PropKind& kind = pick(test::changingProps(), random);
    if (!kind.isRepeatable)
    {
      continue;
    }
    const test::ChangingProp drawn = kind.make(this->renderers_.front());
    this->description_ += std::string("changing prop: ") + kind.name + "\n";
    drawn.leaf->GetUserMatrix()->DeepCopy(this->world_);
    this->changingProps_.push_back(drawn);
    for (vtkRenderer* renderer : this->renderers_)
    {
      renderer->AddViewProp(drawn.prop);
    }
  }
}

void FuzzScene::addLight(Random& random)
{
  const bool isArea = chance(random, 0.3);
  this->lights_.push_back(isArea
      ? vtkSmartPointer<vtkLight>(vtkSmartPointer<vtkGnomonAreaLight>::New())
      : vtkSmartPointer<vtkLight>::New());
  this->settingsOfLights_.emplace_back();
  vtkLight* const light = this->lights_.back();
  light->SetLightTypeToSceneLight();
  light->SetIntensity(uniform(random, 0.1, 0.7));
  light->SetDiffuseColor(uniform(random, 0.2, 1.0), uniform(random, 0.2, 1.0), 1.0);
  this->placeLight(light, random);
  this->shapeLight(light, random);
  if (chance(random, 0.15))
  {
    for (const auto& [name, value] : drawSettings(random))
    {
      this->setLight(this->lights_.size() - 1, name, value);
    }
  }
  for (vtkRenderer* renderer : this->renderers_)
  {
    renderer->AddLight(light);
  }
}

void FuzzScene::placeLight(vtkLight* light, Random& random)
{
  glm::dvec3 target = somewhere(random, 1.5);
  glm::dvec3 from = somewhere(random, chance(random, 0.1) ? 1e4 : 5.0);
  if (chance(random, 0.1)) // along an axis
  {
    const int axis = static_cast<int>(random() % 3);
    from = target;
    from[axis] += chance(random, 0.5) ? 3.0 : -3.0;
  }
  else if (chance(random, 0.5)) // from above
  {
    from.z = std::abs(from.z) + 1.0;
  }
  light->SetPosition(glm::value_ptr(this->inWorld(from)));
  light->SetFocalPoint(glm::value_ptr(this->inWorld(target)));
  if (chance(random, 0.05)) // along the view
  {
    vtkCamera* const camera = this->renderers_.front()->GetActiveCamera();
    light->SetPosition(camera->GetPosition());
    light->SetFocalPoint(camera->GetFocalPoint());
  }
}

void FuzzScene::shapeLight(vtkLight* light, Random& random)
{
  light->SetPositional(random() % 2 == 0);
  light->SetConeAngle(chance(random, 0.3) ? 180.0
      : chance(random, 0.2)               ? pick<double>({ 0.1, 89.9, 90.0, 179.0 }, random)
                                          : uniform(random, 1.0, 89.0));
  light->SetExponent(chance(random, 0.5) ? 0.0 : 1.0);
  vtkGnomonLightKeys::RemoveBox(light);
  if (!light->GetPositional() && chance(random, 0.2))
  {
    const double up[3] = { 0.1, 1.0, 0.2 };
    vtkGnomonLightKeys::SetBox(light, this->unit_ * uniform(random, 0.01, 10.0),
      this->unit_ * uniform(random, 0.01, 10.0), this->unit_ * uniform(random, 0.01, 20.0), up);
  }
  this->description_ += std::string("light: ") + (light->GetPositional() ? "positional" : "sun") +
    ", cone " + std::to_string(light->GetConeAngle());
  if (auto* const area = vtkGnomonAreaLight::SafeDownCast(light))
  {
    // Angles of directional lights, which are below 180 degrees.
    const double unit = light->GetPositional() ? this->unit_ : 10.0;
    area->SetShape(random() % 2 == 0 ? vtkGnomonAreaLight::DISK : vtkGnomonAreaLight::RECTANGLE);
    area->SetRadius(chance(random, 0.1) ? 0.0 : unit * uniform(random, 0.001, 2.0));
    area->SetWidth(unit * uniform(random, 0.001, 3.0));
    area->SetHeight(chance(random, 0.1) ? 0.0 : unit * uniform(random, 0.001, 3.0));
    area->SetUp(0.2, 1.0, 0.1);
    area->SetTexture(chance(random, 0.3) ? drawLightTexture(random) : nullptr);
    this->description_ += std::string(", area, ") +
      (area->GetShape() == vtkGnomonAreaLight::DISK ? "disk" : "rectangle") +
      (area->GetTexture() ? ", textured" : "");
  }
  this->description_ += "\n";
}

void FuzzScene::setLight(std::size_t light, const std::string& name, const std::string& value)
{
  this->settingsOfLights_[light].emplace_back(name, this->allowed(value));
  vtkGnomonLightKeys::SetSetting(this->lights_[light], name.c_str(), this->allowed(value).c_str());
  this->description_ +=
    "light " + std::to_string(light) + ": " + name + "=" + this->allowed(value) + "\n";
}

void FuzzScene::placeCamera(vtkRenderer* renderer, Random& random)
{
  vtkCamera* const camera = renderer->GetActiveCamera();
  const glm::dvec3 target = somewhere(random, 1.0);
  const glm::dvec3 eye = chance(random, 0.15)
    ? somewhere(random, 1.5) // also inside of things
    : target + uniform(random, 1.0, 9.0) * unitVector(random) + glm::dvec3(0.0, 0.0, 2.0);
  camera->SetPosition(glm::value_ptr(this->inWorld(eye)));
  camera->SetFocalPoint(glm::value_ptr(this->inWorld(target)));
  camera->SetViewUp(glm::value_ptr(unitVector(random)));
  camera->SetViewAngle(chance(random, 0.1) ? pick<double>({ 0.01, 1.0, 150.0, 179.0 }, random)
                                           : uniform(random, 10.0, 90.0));
  camera->SetParallelProjection(chance(random, 0.3));
  camera->SetParallelScale(this->unit_ * std::pow(10.0, uniform(random, -1.5, 1.0)));
  renderer->ResetCameraClippingRange();
  this->description_ += std::string("camera: ") +
    (camera->GetParallelProjection() ? "parallel" : "perspective") + ", view angle " +
    std::to_string(camera->GetViewAngle()) + "\n";
}

void FuzzScene::choosePass(Random& random)
{
  this->set(drawSettings(random));
  if (chance(random, 0.7))
  {
    this->set("bake", "always"); // one frame then shows the maps' shadows
  }
  this->pass_->SetSmoothTerminators(chance(random, 0.3));
  this->pass_->SetKeepVisibility(chance(random, 0.7));
  this->pass_->SetRoute(chance(random, 0.7) ? 0 : static_cast<int>(random() % 4));
  this->description_ += "pass: " + textOf(this->settings_) + ", keeps visibility " +
    std::to_string(this->pass_->GetKeepVisibility()) + ", route " +
    std::to_string(this->pass_->GetRoute()) + ", smooth terminators " +
    std::to_string(this->pass_->GetSmoothTerminators()) + "\n";
}

std::string FuzzScene::allowed(const std::string& value) const
{
  const bool isOfItsFrame = value == "once"; // a value of the setting `fit`
  return this->purpose_ == Purpose::Changes && isOfItsFrame ? "frame" : value;
}

void FuzzScene::set(const std::string& name, const std::string& value)
{
  this->settings_.emplace_back(name, this->allowed(value));
  this->pass_->SetSetting(name.c_str(), this->allowed(value).c_str());
}

void FuzzScene::set(const NamedSettings& settings)
{
  for (const auto& [name, value] : settings)
  {
    this->set(name, value);
  }
}

test::Picture FuzzScene::render()
{
  constexpr int mostFrames = 100;
  const tool::VtkMessages messages;
  for (int frame = 0; frame < mostFrames; ++frame)
  {
    // VTK 9.1 draws a renderer at rest with light positions of the other renderer's view.
    for (vtkLight* light : this->lights_)
    {
      light->Modified();
    }
    this->window_->Render();
    this->window_->MakeCurrent();
    checkFrame(this->pass_, messages);
    if (this->pass_->GetProgress() >= 1.0)
    {
      return test::readPicture(this->window_);
    }
  }
  throw Find("not complete after " + std::to_string(mostFrames) + " frames");
}

/// True if a light has an area.
bool FuzzScene::isWide(std::size_t light) const
{
  for (const NamedSettings* settings : { &this->settingsOfLights_[light], &this->settings_ })
  {
    const auto radius = std::find_if(settings->rbegin(), settings->rend(),
      [](const auto& setting) { return setting.first == "light_radius"; });
    if (radius != settings->rend())
    {
      if (std::stod(radius->second) > 0.0)
      {
        return true;
      }
      break; // The light's own area counts.
    }
  }
  auto* const area = vtkGnomonAreaLight::SafeDownCast(this->lights_[light]);
  const bool isDisk = area && area->GetShape() == vtkGnomonAreaLight::DISK;
  const double size = !area ? 0.0
    : isDisk                ? area->GetRadius()
                            : area->GetWidth() + area->GetHeight();
  return size > 0.0;
}

const EstimatorEntry& FuzzScene::estimatorOfLight(std::size_t light) const
{
  ShadowSettings asked;
  for (const NamedSettings* settings : { &this->settings_, &this->settingsOfLights_[light] })
  {
    for (const auto& [name, value] : *settings)
    {
      findSetting(name)->set(asked, value);
    }
  }
  return estimatorOf(asked);
}

void FuzzScene::traceInstead(const std::set<int>& hard)
{
  const TechniqueInfo& rays = findTechnique("raytraced")->estimator->info;
  const auto isKept = [&](const std::string& name)
  { return name != "technique" && name != "estimator" && has(rays, name); };
  for (std::size_t i = 0; i < this->lights_.size(); ++i)
  {
    vtkLight* const light = this->lights_[i];
    for (const auto& [name, value] : this->settingsOfLights_[i])
    {
      vtkGnomonLightKeys::SetSetting(light, name.c_str(), isKept(name) ? value.c_str() : nullptr);
    }
    if (!has(this->estimatorOfLight(i).info, "edge_samples"))
    {
      vtkGnomonLightKeys::SetSetting(light, "edge_samples", "1"); // overrides the pass
    }
    if (hard.count(static_cast<int>(i)) > 0 && this->isWide(i))
    {
      vtkGnomonLightKeys::SetSetting(light, "light_radius", "0");
      if (auto* const area = vtkGnomonAreaLight::SafeDownCast(light))
      {
        area->SetShapeToDisk();
        area->SetRadius(0.0);
        area->SetTexture(nullptr);
      }
    }
  }
  NamedSettings kept{ { "technique", "raytraced" } };
  std::copy_if(this->settings_.begin(), this->settings_.end(), std::back_inserter(kept),
    [&](const auto& setting) { return isKept(setting.first); });
  this->replacePass(kept);
}

void FuzzScene::renewPass()
{
  this->replacePass(this->settings_);
}

void FuzzScene::replacePass(const NamedSettings& settings)
{
  auto fresh = vtkSmartPointer<vtkGnomonShadowPass>::New();
  for (const auto& [name, value] : settings)
  {
    fresh->SetSetting(name.c_str(), value.c_str());
  }
  fresh->SetSmoothTerminators(this->pass_->GetSmoothTerminators());
  fresh->SetKeepVisibility(this->pass_->GetKeepVisibility());
  fresh->SetRoute(this->pass_->GetRoute());
  this->pass_->ReleaseGraphicsResources(this->window_);
  for (vtkRenderer* renderer : this->renderers_)
  {
    if (renderer->GetPass() == this->pass_)
    {
      renderer->SetPass(fresh);
    }
  }
  this->pass_ = fresh;
}

void FuzzScene::removePass()
{
  for (vtkRenderer* renderer : this->renderers_)
  {
    renderer->SetPass(nullptr);
  }
}

bool FuzzScene::showsTranslucent() const
{
  return std::any_of(this->props_.begin(), this->props_.end(),
    [](vtkProp3D* prop)
    {
      vtkActor* const actor = vtkActor::SafeDownCast(prop);
      return actor && actor->HasTranslucentPolygonalGeometry() != 0;
    });
}

} // namespace gnomon::fuzz
