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

/// Draws what a view shows: the scene by the technique, by the truth, or a picture of what both
/// say of its pixels. In every frame, so that it stays true while camera and lights move.
class ViewPass : public vtkRenderPass
{
public:
  static ViewPass* New();
  vtkTypeMacro(ViewPass, vtkRenderPass);

  /// @param lights the scene's, as the state places them
  /// @param renderer that has them already
  void setUp(const ViewState& state, const std::vector<SceneLight>& lights, vtkRenderer* renderer);
  /// For the next setUp(): whether pictures are to be complete and to depend on nothing but the
  /// state, with all samples of area lights at once, and maps baked.
  void setStill(bool still) { this->still_ = still; }

  void Render(const vtkRenderState* s) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  /// The pass whose picture is shown.
  vtkGnomonShadowPass* shown()
  {
    return this->state_.show == Show::Truth ? this->truth_ : this->technique_;
  }
  /// What lights get from the technique's pass.
  const ShadowSettings& settings() const { return this->settings_; }
  /// What lights of the last frame saw; null unless frusta, texels or a probe asked for it.
  const LightSights* sights() const { return this->sighted_ ? &this->sights_ : nullptr; }

  ///@{
  /// Of the last frame.
  const std::optional<VisibilityError>& error() const { return this->error_; } ///< Show::Error
  /// Why the picture is not the one that was asked for; empty if it is.
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
