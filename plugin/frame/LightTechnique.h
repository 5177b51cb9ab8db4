#pragma once

#include "lights/CameraView.h"
#include "lights/LightViews.h"
#include "lights/MapReach.h"
#include "lights/ShadowLight.h"
#include "plugin/frame/ValueKey.h"
#include "plugin/plan/BakeBackoff.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/base/vtkGnomonFrameCounts.h"
#include "shadowtech/fitting/ReceiverFit.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace gnomon
{

/// Inputs for baking the maps of a frame's lights.
struct MapStage
{
  const CameraView& camera;
  const Occluders& occluders;
  OccluderBuffers& buffers; ///< updated to the occluders when a map is baked
  ShaderLibrary& shaders;
  ///@{
  /// For views fitted to receivers (ShadowLight::fittedToReceivers).
  const ReceiverTarget& receivers;
  const glm::dmat4& centredFromView; ///< of the camera that drew them
  std::size_t receiversNumber;       ///< ReceiversValue::number
  ///@}
  bool bakesOptional; ///< false: bakes of optional maps wait for a later frame
  FrameCounts& counts;
  /// The box around surfaces that show shadows and are not in the snapshot; empty: none are known.
  Bounds pointsCentred = {};
  bool servesPointsAlone = false; ///< true if maps need to serve no others
};

/// One light's technique, with its maps and their inputs, cached from frame to frame. BakeBackoff
/// decides when to bake maps that the technique can do without.
class LightTechnique
{
public:
  explicit LightTechnique(const EstimatorEntry& estimator);

  const EstimatorEntry& estimator() const { return *this->estimator_; }
  const TechniqueInfo& info() const { return this->estimator_->info; }
  Technique& technique() const { return baseOf(this->technique_); }
  /// Return the technique if it is of a kind; else null.
  template <typename Kind>
  Kind* as() const
  {
    const auto* technique = std::get_if<std::unique_ptr<Kind>>(&this->technique_);
    return technique ? technique->get() : nullptr;
  }

  /// Bake the maps if they are stale and worth it.
  /// @throws TextureMemoryError that names the light, for maps without room
  void updateMaps(const ShadowLight& light, const MapStage& stage, LightCounts& counts);
  /// True if this frame's visibility uses the maps.
  bool usesMap() const { return this->usesMap_; }

  /// Store whether the last visibility would trace shadow rays in much of the picture without a
  /// map. Other lights gain nothing by a new map.
  void tellRays(bool tookMany) { this->takesRays_ = tookMany; }

  /// Return the layout of this frame's views, for other views, whether or not maps were baked.
  const ViewFitting& fitting() const { return this->fitting_; }

private:
  /// The maps stage's value.
  struct Bake
  {
    std::optional<ValueKey> key; ///< none: there are no maps, or baking failed half way
    LightViews views;
    std::optional<CameraView> camera; ///< to which the views were fitted
    int castersLeftOut = 0;

    /// Return the inputs that differ from those of these maps; empty if they can be reused.
    std::string changesTo(const Bake& wanted) const;
  };

  std::string reasonAgainstMap(const ShadowLight& light, const MapStage& stage, bool isBaked) const;
  LightViews layOut(const ShadowLight& light, const MapStage& stage, const MapReach& reach);
  Bake wantedIn(const ShadowLight& light, const MapStage& stage);
  void bake(const ShadowLight& light, const MapStage& stage, Bake wanted);

  const EstimatorEntry* estimator_;
  AnyTechnique technique_;
  ViewFitting fitting_;
  Bake baked_;
  Bake wanted_;         ///< the last frame's wanted inputs of optional maps
  BakeBackoff backoff_; ///< of optional maps
  bool usesMap_ = true;
  bool takesRays_ = true; ///< assume many until it is known
  ReceiverFit receiverFit_;
};

/// Run a light's work. Errors about missing memory then name the light.
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
