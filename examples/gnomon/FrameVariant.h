#pragma once

#include "Comparison.h"
#include "Errors.h"
#include "Scene.h"
#include "SettingOptions.h"

#include "lights/SettingsTable.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/Clock.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkRenderPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkShadowMapBakerPass.h>
#include <vtkShadowMapPass.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>
#include <vtksys/SystemInformation.hxx>

namespace gnomon::tool
{

/// One way to render a scene.
struct VariantSpec
{
  std::string technique; ///< a name of the registry or of a peer
  int mapSizeTexels = 0; ///< 0: no map
  int route = vtkGnomonShadowPass::ROUTE_AUTO;
  bool pointwise = false; ///< true if the technique has two routes
  /// Other settings of the lights' shadows, by name (lights/ShadowSettings.h).
  std::map<std::string, std::string> settings = {};

  bool isGnomon() const
  {
    return this->technique != plainTechnique && this->technique != shadowMapPassTechnique;
  }
  /// Return "inline", "image", or "" for variants without routes.
  std::string routeName() const
  {
    return !this->pointwise                              ? ""
      : this->route == vtkGnomonShadowPass::ROUTE_INLINE ? "inline"
                                                         : "image";
  }

  /// Return a name for users: "nsm fit=frame 1024 inline".
  std::string name() const
  {
    std::string text = this->technique;
    for (const auto& [name, value] : this->settings)
    {
      text += " " + name + "=" + value;
    }
    text += this->mapSizeTexels > 0 ? " " + std::to_string(this->mapSizeTexels) : "";
    text += this->pointwise ? " " + this->routeName() : "";
    return text;
  }
};

inline ShadowSettings settingsOf(const VariantSpec& spec)
{
  ShadowSettings settings;
  settings.technique = spec.technique;
  for (const auto& [name, value] : spec.settings)
  {
    findSetting(name)->set(settings, value);
  }
  return settings;
}

/// Parse a text such as "pcf:kernel=box:projection=lispsm" as a variant without map size and route.
/// @throws BadInput with the name of an unknown technique or setting, or of a setting that the
/// technique lacks
inline VariantSpec parseTechnique(const std::string& text)
{
  std::istringstream parts(text);
  VariantSpec spec;
  std::getline(parts, spec.technique, ':');
  if (!findTechnique(spec.technique) && spec.technique != automaticTechnique)
  {
    throw BadInput(
      "--techniques: found \"" + spec.technique + "\", expected some of: " + techniqueNames());
  }
  const auto refuse = [&](const std::string& why)
  { throw BadInput("--techniques: " + text + ": " + why); };
  for (std::string part; std::getline(parts, part, ':');)
  {
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
    const Setting* const setting = findSetting(name);
    if (!setting || name == "technique" || name == "map_size")
    {
      refuse("found the setting \"" + name + "\", expected one of: " + settingNames() +
        " (except technique, map_size and light_radius)");
    }
    if (isOfLight(*setting))
    {
      refuse("found the setting \"" + name +
        "\", which defines the lights of all techniques, expected in a light of the scene, or " +
        optionOf(name));
    }
    if (ShadowSettings scratch; !setting->set(scratch, value))
    {
      refuse(name + ": found \"" + value + "\", expected " + setting->expected());
    }
    spec.settings[name] = value;
  }
  const TechniqueInfo& info = estimatorOf(settingsOf(spec)).info;
  for (const auto& [name, value] : spec.settings)
  {
    if (!has(info, name))
    {
      refuse(whoHas(*findSetting(name)));
    }
  }
  return spec;
}

/// Set a pass up to draw a variant that isGnomon(). Its other settings return to their defaults.
inline void setUp(vtkGnomonShadowPass* pass, const VariantSpec& spec)
{
  pass->SetSettings(nullptr);
  pass->SetSetting("edge_samples", "1"); // all techniques are compared at the pixels' centres
  pass->SetTechnique(spec.technique.c_str());
  pass->SetRoute(spec.route);
  pass->SmoothTerminatorsOff(); // and on the triangles
  if (spec.mapSizeTexels > 0)
  {
    pass->SetMapSize(spec.mapSizeTexels);
  }
  for (const auto& [name, value] : spec.settings)
  {
    pass->SetSetting(name.c_str(), value.c_str());
  }
}

/// Return VTK's own shadow passes, chained as in its documentation.
inline vtkSmartPointer<vtkRenderPass> makeShadowMapPass(int mapSizeTexels)
{
  vtkNew<vtkShadowMapPass> shadows;
  shadows->GetShadowMapBakerPass()->SetResolution(static_cast<unsigned int>(mapSizeTexels));
  vtkNew<vtkRenderPassCollection> steps;
  steps->AddItem(shadows->GetShadowMapBakerPass());
  steps->AddItem(shadows);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(steps);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  return camera;
}

/// Return a variant's pass, for vtkRenderer::SetPass(); null for plain VTK.
inline vtkSmartPointer<vtkRenderPass> makePass(const VariantSpec& spec)
{
  if (spec.isGnomon())
  {
    auto pass = vtkSmartPointer<vtkGnomonShadowPass>::New();
    setUp(pass, spec);
    return pass;
  }
  return spec.technique == shadowMapPassTechnique ? makeShadowMapPass(spec.mapSizeTexels) : nullptr;
}

/// Return the scene with lights that keep their size only. Technique, map size and kernel come from
/// the pass, hence from the variant.
inline Scene withoutShadowSettings(Scene scene)
{
  for (SceneLight& light : scene.lights)
  {
    std::map<std::string, std::string> ofLight;
    std::copy_if(light.settings.begin(), light.settings.end(),
      std::inserter(ofLight, ofLight.end()),
      [](const auto& entry) { return isOfLight(*findSetting(entry.first)); });
    light.settings = std::move(ofLight);
  }
  return scene;
}

/// Render a frame, wait for its end, and return its wall clock time in milliseconds.
inline double drawTimed(vtkRenderWindow* window)
{
  window->MakeCurrent();
  const double start = steadyMilliseconds();
  window->Render();
  window->WaitForCompletion();
  return steadyMilliseconds() - start;
}

/// A variant with its own window, renderer and pass.
class FrameVariant
{
public:
  /// The turn of camera and lights per step, in degrees.
  static constexpr double stepDegrees = 0.05;

  /// @param scene must outlive this object
  FrameVariant(const VariantSpec& spec, const Scene& scene, int width, int height)
    : spec_(spec)
    , scene_(scene)
    , renderer_(makeRenderer(scene, static_cast<double>(width) / height))
  {
    this->camera_->DeepCopy(this->renderer_->GetActiveCamera());
    this->renderer_->SetPass(makePass(spec));
    this->window_->SetSize(width, height);
    this->window_->AddRenderer(this->renderer_);
  }

  const VariantSpec& spec() const { return this->spec_; }
  /// Return the pass; null for the peers.
  vtkGnomonShadowPass* pass() const
  {
    return vtkGnomonShadowPass::SafeDownCast(this->renderer_->GetPass());
  }
  vtkRenderer* renderer() const { return this->renderer_; }
  vtkRenderWindow* window() const { return this->window_; }

  /// True if a light's map will be baked after some more frames at rest.
  bool awaitsMap() const
  {
    const auto awaits = [](const LightReport& light) { return !light.mapReason.empty(); };
    return this->pass() &&
      std::any_of(
        this->pass()->GetReport().lights.begin(), this->pass()->GetReport().lights.end(), awaits);
  }

  /// Render one frame, wait for its end, and return its wall clock time in milliseconds. Camera and
  /// lights are those of the scene; the moving one is turned by `step` steps.
  double drawFrame(Motion motion, int step)
  {
    this->turnCamera(motion == Motion::Camera ? step * stepDegrees : 0.0);
    this->turnLights(motion == Motion::Light ? step * stepDegrees : 0.0);
    if (this->pass())
    {
      this->pass()->SetInteractive(motion == Motion::Static ? vtkGnomonShadowPass::INTERACTIVE_OFF
                                                            : vtkGnomonShadowPass::INTERACTIVE_ON);
    }
    return drawTimed(this->window_);
  }

private:
  void turnCamera(double degrees)
  {
    if (degrees == this->cameraDegrees_)
    {
      return;
    }
    this->cameraDegrees_ = degrees;
    vtkCamera* const camera = this->renderer_->GetActiveCamera();
    camera->SetPosition(this->camera_->GetPosition());
    camera->SetFocalPoint(this->camera_->GetFocalPoint());
    camera->SetViewUp(this->camera_->GetViewUp());
    camera->SetClippingRange(this->camera_->GetClippingRange());
    if (degrees != 0.0)
    {
      camera->Azimuth(degrees);
      camera->OrthogonalizeViewUp();
      this->renderer_->ResetCameraClippingRange();
    }
  }

  // Each light turns around its target about an axis across its direction, so the direction always
  // changes.
  void turnLights(double degrees)
  {
    if (degrees == this->lightDegrees_)
    {
      return;
    }
    this->lightDegrees_ = degrees;
    for (std::size_t i = 0; i < this->scene_.lights.size(); ++i)
    {
      const SceneLight& base = this->scene_.lights[i];
      const glm::dvec3 target(base.target[0], base.target[1], base.target[2]);
      const glm::dvec3 arm =
        glm::dvec3(base.position[0], base.position[1], base.position[2]) - target;
      const glm::dvec3 across = std::abs(arm.x) < 0.5 * glm::length(arm)
        ? glm::dvec3(1.0, 0.0, 0.0)
        : glm::dvec3(0.0, 1.0, 0.0);
      const glm::dmat4 turn =
        glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::cross(arm, across));
      const glm::dvec3 position = target + glm::dvec3(turn * glm::dvec4(arm, 0.0));
      vtkLight* const light =
        vtkLight::SafeDownCast(this->renderer_->GetLights()->GetItemAsObject(static_cast<int>(i)));
      light->SetPosition(position.x, position.y, position.z);
    }
  }

  VariantSpec spec_;
  const Scene& scene_;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkOpenGLRenderWindow> window_ = makeOffScreenWindow();
  vtkNew<vtkCamera> camera_; ///< the scene's
  double cameraDegrees_ = 0.0;
  double lightDegrees_ = 0.0;
};

/// The number of frames that are rendered but not counted after a change of motion.
inline constexpr int warmUpFrames = 3;

/// Return the median: the upper of two middle values, or 0 without values.
inline double median(std::vector<double> values)
{
  if (values.empty())
  {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Return the median wall clock time per frame of each of several ways to draw, in milliseconds.
/// Their frames are interleaved, so other load of the machine affects all alike.
/// @param frames number of counted frames, after warmUpFrames others
/// @param draw renders a frame of a way, at a step from 1, and returns its milliseconds
/// @param roundDone called after each round of one frame per way; may be empty
inline std::vector<double> timeFrames(std::size_t ways, int frames,
  const std::function<double(std::size_t way, int step)>& draw,
  const std::function<void()>& roundDone = {})
{
  std::vector<std::vector<double>> times(ways);
  for (int frame = -warmUpFrames; frame < frames; ++frame)
  {
    for (std::size_t i = 0; i < ways; ++i)
    {
      const double milliseconds = draw(i, frame + warmUpFrames + 1);
      if (frame >= 0)
      {
        times[i].push_back(milliseconds);
      }
    }
    if (roundDone)
    {
      roundDone();
    }
  }
  std::vector<double> medians(ways);
  std::transform(times.begin(), times.end(), medians.begin(), median);
  return medians;
}

/// Return this process' resident memory in bytes; 0 if it is unknown.
inline std::int64_t residentBytes()
{
  return 1024 * static_cast<std::int64_t>(vtksys::SystemInformation().GetProcMemoryUsed());
}

/// Return the processor's model and its number of hardware threads.
inline std::string processorName()
{
  vtksys::SystemInformation system;
  system.RunCPUCheck();
  return system.GetModelName() + std::string(", ") +
    std::to_string(std::thread::hardware_concurrency()) + " threads";
}

inline std::string openGlName(vtkRenderWindow* window)
{
  const std::string capabilities = window->ReportCapabilities();
  const auto valueOf = [&](const std::string& key)
  {
    const std::size_t begin =
      capabilities.find_first_not_of(" \t", capabilities.find(key) + key.size());
    return capabilities.substr(begin, capabilities.find('\n', begin) - begin);
  };
  return valueOf("OpenGL renderer string:") + ", version " + valueOf("OpenGL version string:");
}

} // namespace gnomon::tool
