#include "view/ViewPass.h"

#include "ComparisonRun.h"
#include "Text.h"

#include "lights/LightManager.h"
#include "plugin/scene/ShownView.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderState.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::tool
{
namespace
{

/// Draw a picture into the bound framebuffer, without depths.
void drawPicture(const Picture& picture, vtkRenderWindow* window)
{
  const std::size_t rowBytes = 3 * static_cast<std::size_t>(picture.width);
  std::vector<unsigned char> bottomUp;
  bottomUp.reserve(picture.rgb.size());
  for (int y = picture.height - 1; y >= 0; --y)
  {
    const auto row = picture.rgb.begin() + static_cast<std::ptrdiff_t>(y * rowBytes);
    bottomUp.insert(bottomUp.end(), row, row + static_cast<std::ptrdiff_t>(rowBytes));
  }
  static_cast<vtkOpenGLRenderWindow*>(window)->DrawPixels(
    picture.width, picture.height, 3, VTK_UNSIGNED_CHAR, bottomUp.data());
}

/// Set a pass up unless it has this set-up already.
void setUpOnce(vtkGnomonShadowPass* pass, const VariantSpec& spec, std::string& setUpFor)
{
  const std::string name = spec.name() + (spec.settings.count("bake") ? " baked" : "");
  if (name != setUpFor)
  {
    setUp(pass, spec);
    setUpFor = name;
  }
}

/// True if the technique of any light has the setting.
bool anyHas(vtkRenderer* renderer, const ShadowSettings& settings, const char* name)
{
  const std::vector<ShadowLight> lights = LightManager().collect(renderer, settings).lights;
  return std::any_of(lights.begin(), lights.end(),
    [name](const ShadowLight& light) { return has(estimatorOfLight(light).info, name); });
}

/// Return a seed that differs from the technique's.
std::string otherSeed(const ShadowSettings& settings)
{
  return findSetting("light_seed")->get(settings) == "1" ? "2" : "1";
}

} // namespace

vtkStandardNewMacro(ViewPass);

//------------------------------------------------------------------------------
void ViewPass::setUp(
  const ViewState& state, const std::vector<SceneLight>& lights, vtkRenderer* renderer)
{
  this->state_ = state;
  this->lights_ = lights;
  VariantSpec technique = variantOf(state);
  // Pixels' classes must depend on this frame alone, so maps are baked at once. `auto` keeps its
  // usual behaviour, except in saved pictures.
  if ((this->still_ || technique.technique != automaticTechnique) &&
    anyHas(renderer, settingsOf(technique), "bake"))
  {
    technique.settings.emplace("bake", "always");
  }
  setUpOnce(this->technique_, technique, this->techniqueSetUp_);
  this->settings_ = settingsOf(technique);
  this->settings_.mapSizeTexels = state.mapSizeTexels;
  VariantSpec truth{ truthTechnique };
  truth.settings = truthSettings(state.truthSamples, otherSeed(this->settings_));
  setUpOnce(this->truth_, truth, this->truthSetUp_);

  // Reading visibility back takes time.
  const bool probed = state.probe.has_value();
  this->technique_->SetKeepVisibility(probed || state.show > Show::Truth);
  this->truth_->SetKeepVisibility(probed || state.show == Show::Error);
  for (vtkGnomonShadowPass* const pass : { this->technique_.Get(), this->truth_.Get() })
  {
    pass->SetInteractive(
      this->still_ ? vtkGnomonShadowPass::INTERACTIVE_OFF : vtkGnomonShadowPass::INTERACTIVE_AUTO);
  }
}

//------------------------------------------------------------------------------
void ViewPass::Render(const vtkRenderState* s)
{
  vtkRenderer* const renderer = s->GetRenderer();
  vtkRenderWindow* const window = renderer->GetRenderWindow();
  this->error_.reset();
  this->complaint_.clear();
  if (renderer->GetSelector())
  {
    this->technique_->Render(s); // steps aside
    return;
  }
  this->sighted_ = this->state_.frusta || this->state_.probe || this->state_.show == Show::Texels;
  if (this->sighted_)
  {
    this->sights_.update(renderer, this->settings_);
  }
  const bool paints = this->state_.show > Show::Truth;
  if (!paints)
  {
    this->shown()->Render(s);
  }
  else
  {
    this->drawAll(this->technique_, s);
    const Picture picture = capture(window);
    drawPicture(this->state_.show == Show::Error ? this->errors(picture, s)
        : this->state_.show == Show::Texels      ? this->texels(picture, renderer)
                                                 : this->classes(picture),
      window);
  }
  this->NumberOfRenderedProps = this->shown()->GetNumberOfRenderedProps();
}

//------------------------------------------------------------------------------
/// Render until area lights have all samples, which descriptions of pixels need.
void ViewPass::drawAll(vtkGnomonShadowPass* pass, const vtkRenderState* s)
{
  do
  {
    pass->Render(s);
  } while (pass->GetProgress() < 1.0);
}

//------------------------------------------------------------------------------
Picture ViewPass::errors(const Picture& picture, const vtkRenderState* s)
{
  this->drawAll(this->truth_, s);
  const VisibilityImages& found = this->technique_->GetVisibility();
  try
  {
    this->error_ = measureError(found, this->truth_->GetVisibility(), this->lights_);
    return errorPicture(picture, this->error_->verdicts);
  }
  catch (const std::invalid_argument& error)
  {
    this->complaint_ = error.what();
    return picture;
  }
}

//------------------------------------------------------------------------------
Picture ViewPass::classes(const Picture& picture)
{
  const Picture classes =
    classPicture(this->technique_->GetVisibility(), static_cast<int>(this->state_.light));
  this->complaint_ = classes.rgb.empty() ? "this technique tells no classes" : "";
  return classes.rgb.empty() ? picture : classes;
}

//------------------------------------------------------------------------------
Picture ViewPass::texels(const Picture& picture, vtkRenderer* renderer)
{
  const LightSight* const sight = this->sights_.find(static_cast<int>(this->state_.light));
  if (!sight || sight->views.views.empty())
  {
    this->complaint_ = "this technique has no map here";
    return picture;
  }
  const SceneFrame& frame = this->sights_.snapshot().occluders().frame;
  return texelPicture(
    picture, this->technique_->GetVisibility(), *sight, frame, shownView(renderer, frame).camera);
}

//------------------------------------------------------------------------------
void ViewPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->technique_->ReleaseGraphicsResources(window);
  this->truth_->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

} // namespace gnomon::tool
