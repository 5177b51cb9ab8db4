#pragma once

#include "plugin/frame/Frame.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/transmittance/VolumeStack.h"
#include "shadowtech/transmittance/VolumeTexture.h"
#include "shadowtech/transmittance/Volumes.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>

namespace gnomon
{

/// The volumes of a snapshot that cast, and the stack of each light that asks for one. A stack is
/// built where a stage first asks, and kept while light, volumes and resolution stay.
class VolumeStage
{
public:
  /// @param occluders the snapshot, which lives as long as this
  VolumeStage(Frame& frame, const Occluders& occluders)
    : frame_(frame)
    , occluders_(occluders)
  {
  }

  /// Return the volumes, up to date with the snapshot.
  const Volumes& volumes();
  /// Return a light's stack. Some volume casts.
  const VolumeStack& stackOf(const LightPlan& light);
  /// Return those of an area light's points.
  const AreaStacks& areaStacksOf(const LightPlan& light);
  /// Return a light's stack for shaders.
  const VolumeTexture& textureOf(const LightPlan& light);
  /// Have the frame's pointwise techniques see the volumes, if any casts. Drops the stacks of
  /// lights that are gone.
  void attach();

  std::size_t bytes() const
  {
    return bytesOfAll(this->stacks_,
      [](const auto& of)
      {
        const LightStack& one = of.second;
        return (one.stack ? one.stack->bytes() : 0) + (one.ofArea ? one.ofArea->bytes() : 0);
      });
  }

private:
  struct LightStack
  {
    RayIdentity light;
    int resolution = 0;
    ///@{
    /// Null until asked for.
    std::unique_ptr<VolumeStack> stack;
    std::unique_ptr<AreaStacks> ofArea;
    std::unique_ptr<VolumeTexture> texture; ///< of `stack`
    ///@}
  };
  LightStack& find(const LightPlan& light);

  Frame& frame_;
  const Occluders& occluders_;
  Volumes volumes_;
  std::map<int, LightStack> stacks_; ///< by ShadowLight::sceneIndex
};

} // namespace gnomon
