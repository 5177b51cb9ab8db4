#pragma once

#include "lights/CameraView.h"
#include "lights/LightViews.h"
#include "lights/MapReach.h"
#include "lights/ShadowLight.h"
#include "plugin/frame/BakeBackoff.h"
#include "plugin/frame/MapRasterizer.h"
#include "plugin/frame/Route.h"
#include "plugin/frame/ValueKey.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"
#include "shadowtech/fitting/ReceiverFit.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace gnomon
{

/// What the lights of a frame have their maps drawn from, and by whom.
struct MapStage
{
  const CameraView& camera;
  const Occluders& occluders;
  OccluderBuffers& buffers;    ///< brought up to date with the occluders where a map is drawn
  RasterizerChoice rasterizer; ///< of conservative maps
  ShaderLibrary& shaders;
  ///@{
  /// What views are fitted to that await it (ShadowLight::fittedToReceivers).
  const ReceiverTarget& receivers;
  const glm::dmat4& centredFromView; ///< the camera's that they were drawn by
  std::size_t receiversNumber;       ///< ReceiversValue::number
  ///@}
  FrameReport& report;
};

/// One light's technique, and its maps from frame to frame: what they were drawn from, and so
/// whether they serve. BakeBackoff decides when to bake maps that the technique can do without.
class LightTechnique
{
public:
  explicit LightTechnique(const EstimatorEntry& estimator);

  const EstimatorEntry& estimator() const { return *this->estimator_; }
  const TechniqueInfo& info() const { return this->estimator_->info; }
  Technique& technique() const { return baseOf(this->technique_); }
  /// The technique if it is of a kind; else null.
  template <typename Kind>
  Kind* as() const
  {
    const auto* technique = std::get_if<std::unique_ptr<Kind>>(&this->technique_);
    return technique ? technique->get() : nullptr;
  }

  /// States what the light's views are fitted to on a route, in the light and in the report: the
  /// receivers that are drawn, which are the tightest, unless there is a reason not to.
  /// @param translucentReceivers whether translucent surfaces receive
  void chooseFit(
    ShadowLight& light, Route route, bool translucentReceivers, LightReport& report) const;

  /// Has the maps drawn where those that there are do not serve, and they are worth it.
  /// @throws TextureMemoryError that names the light, for maps without room
  void updateMaps(const ShadowLight& light, const MapStage& stage, LightReport& report);
  /// Whether this frame's visibility is to be computed with the maps.
  bool usesMap() const { return this->usesMap_; }

  /// Tells whether the last visibility would take shadow rays in much of the picture without a map:
  /// other lights gain nothing by a new one.
  void tellRays(bool tookMany) { this->takesRays_ = tookMany; }

  /// How the views were laid out in this frame, and others may be: whether or not maps were drawn.
  const ViewFitting& fitting() const { return this->fitting_; }

private:
  /// The maps stage's value.
  struct Bake
  {
    std::optional<ValueKey> key; ///< none: there are no maps, or they were given up half way
    LightViews views;
    std::optional<CameraView> camera; ///< that the views were fitted to
    /// Who draws a conservative map; none for other maps.
    std::optional<RasterizerChoice> rasterizer;
    int castersLeftOut = 0;

    /// What is wanted otherwise than these maps were baked from; empty where they serve.
    std::string changesTo(const Bake& wanted) const;
    void tell(LightReport& report) const;
    bool isDrawnOnGpu() const { return this->rasterizer && this->rasterizer->gpu; }
  };

  std::string reasonAgainstReceivers(
    const ShadowLight& light, Route route, bool translucentReceivers) const;
  LightViews layOut(const ShadowLight& light, const MapStage& stage, const MapReach& reach);
  Bake wantedIn(const ShadowLight& light, const MapStage& stage);
  void bake(const ShadowLight& light, const MapStage& stage, Bake wanted);

  const EstimatorEntry* estimator_;
  AnyTechnique technique_;
  ViewFitting fitting_;
  Bake baked_;
  Bake wanted_;         ///< what optional maps were to be baked from in the last frame
  BakeBackoff backoff_; ///< of optional maps
  bool usesMap_ = true;
  bool takesRays_ = true; ///< many, as far as is known
  ReceiverFit receiverFit_;
};

/// Does a light's work; what it says of memory that is not there then names the light.
template <typename Work>
void namingLight(const ShadowLight& light, const Work& work)
{
  try
  {
    work();
  }
  catch (const TextureMemoryError& error)
  {
    throw TextureMemoryError(nameOf(light) + ": " + error.what());
  }
}

} // namespace gnomon
