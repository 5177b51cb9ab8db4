#pragma once

#include "Comparison.h"
#include "view/LightSights.h"
#include "view/ViewState.h"

#include "lights/ShadowSettings.h"
#include "plugin/vtkGnomonShadowPass.h"

#include <vtkNew.h>
#include <vtkRenderPass.h>

#include <optional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Draws the scene by the technique or by the truth, or a picture that compares both. It computes
/// the picture in every frame, so it follows camera and lights.
class ViewPass : public vtkRenderPass
{
public:
  static ViewPass* New();
  vtkTypeMacro(ViewPass, vtkRenderPass);

  /// @param lights the scene's, at their places in the state
  /// @param renderer has these lights already
  void setUp(const ViewState& state, const std::vector<SceneLight>& lights, vtkRenderer* renderer);
  /// Set whether pictures of the next setUp() depend on the state alone: all samples of area lights
  /// at once, and baked maps.
  void setStill(bool still) { this->still_ = still; }

  void Render(const vtkRenderState* s) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  /// Return the pass whose picture is shown.
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
  void drawAll(vtkGnomonShadowPass* pass, const vtkRenderState* s);
  Picture errors(const Picture& picture, const vtkRenderState* s);
  Picture classes(const Picture& picture);
  Picture texels(const Picture& picture, vtkRenderer* renderer);

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
