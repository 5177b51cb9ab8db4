#pragma once

#include "Comparison.h"
#include "ComparisonRun.h"
#include "view/LightSights.h"
#include "view/ViewState.h"

#include "lights/LightManager.h"
#include "lights/ShadowSettings.h"
#include "plugin/scene/ShownView.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderPass.h>
#include <vtkRenderState.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Draws the scene by the technique or by the truth, or a picture that compares both. It computes
/// the picture in every frame, so it follows camera and lights.
class ViewPass : public vtkRenderPass
{
public:
  static ViewPass* New() { VTK_STANDARD_NEW_BODY(ViewPass); }

  vtkTypeMacro(ViewPass, vtkRenderPass);

  /// @param lights the scene's, at their places in the state
  /// @param renderer has these lights already
  void setUp(const ViewState& state, const std::vector<SceneLight>& lights, vtkRenderer* renderer)
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
      pass->SetInteractive(this->still_ ? vtkGnomonShadowPass::INTERACTIVE_OFF
                                        : vtkGnomonShadowPass::INTERACTIVE_AUTO);
    }
  }

  /// Set whether pictures of the next setUp() depend on the state alone: all samples of area lights
  /// at once, and baked maps.
  void setStill(bool still) { this->still_ = still; }

  void Render(const vtkRenderState* s) override
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

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->technique_->ReleaseGraphicsResources(window);
    this->truth_->ReleaseGraphicsResources(window);
    this->Superclass::ReleaseGraphicsResources(window);
  }

  vtkGnomonShadowPass* shown()
  {
    return this->state_.show == Show::Truth ? this->truth_ : this->technique_;
  }
  /// Return the settings of the technique's pass.
  const ShadowSettings& settings() const { return this->settings_; }
  /// Return the light views of the last frame; null unless frusta, texels or a probe use them.
  const LightSights* sights() const { return this->sighted_ ? &this->sights_ : nullptr; }

  ///@{
  /// Of the last frame.
  const std::optional<VisibilityError>& error() const { return this->error_; } ///< Show::Error
  /// Return why the picture is not the requested one; empty if it is.
  const std::string& complaint() const { return this->complaint_; }
  ///@}

protected:
  ViewPass() = default;
  ~ViewPass() override = default;

private:
  /// Draw a picture into the bound framebuffer, without depths.
  static void drawPicture(const Picture& picture, vtkRenderWindow* window)
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
  static void setUpOnce(vtkGnomonShadowPass* pass, const VariantSpec& spec, std::string& setUpFor)
  {
    const std::string name = spec.name() + (spec.settings.count("bake") ? " baked" : "");
    if (name != setUpFor)
    {
      gnomon::tool::setUp(pass, spec);
      setUpFor = name;
    }
  }

  static bool anyHas(vtkRenderer* renderer, const ShadowSettings& settings, const char* name)
  {
    const std::vector<ShadowLight> lights = LightManager().collect(renderer, settings).lights;
    return std::any_of(lights.begin(), lights.end(),
      [name](const ShadowLight& light) { return has(estimatorOfLight(light).info, name); });
  }

  /// Return a seed that differs from the technique's.
  static std::string otherSeed(const ShadowSettings& settings)
  {
    return findSetting("light_seed")->get(settings) == "1" ? "2" : "1";
  }

  /// Render until area lights have all samples, which descriptions of pixels need.
  void drawAll(vtkGnomonShadowPass* pass, const vtkRenderState* s)
  {
    do
    {
      pass->Render(s);
    } while (pass->GetProgress() < 1.0);
  }

  Picture errors(const Picture& picture, const vtkRenderState* s)
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

  Picture classes(const Picture& picture)
  {
    const Picture classes =
      classPicture(this->technique_->GetVisibility(), static_cast<int>(this->state_.light));
    this->complaint_ = classes.rgb.empty() ? "this technique tells no classes" : "";
    return classes.rgb.empty() ? picture : classes;
  }

  Picture texels(const Picture& picture, vtkRenderer* renderer)
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

  vtkNew<vtkGnomonShadowPass> technique_;
  vtkNew<vtkGnomonShadowPass> truth_;
  ViewState state_;
  std::vector<SceneLight> lights_;
  ShadowSettings settings_;
  std::string techniqueSetUp_; ///< what technique_ was set up for
  std::string truthSetUp_;
  bool still_ = false;
  LightSights sights_;
  bool sighted_ = false;
  std::optional<VisibilityError> error_;
  std::string complaint_;
};

} // namespace gnomon::tool
