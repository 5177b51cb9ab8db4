#pragma once

#include "plugin/frame/Frame.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/transmittance/PointFilter.h"
#include "shadowtech/transmittance/SheetMap.h"
#include "shadowtech/transmittance/Sheets.h"
#include "shadowtech/transmittance/VolumeStack.h"
#include "shadowtech/transmittance/VolumeTexture.h"
#include "shadowtech/transmittance/Volumes.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon
{

/// A snapshot's casters that let light through, with stacks and maps for the lights that ask.
/// They are built where a stage first asks, and kept while light, casters and resolution stay.
class TransmittanceStage
{
public:
  /// @param occluders the snapshot, which lives as long as this
  TransmittanceStage(Frame& frame, const Occluders& occluders)
    : frame_(frame)
    , occluders_(occluders)
  {
  }

  /// Return the volumes, up to date with the snapshot.
  const Volumes& volumes();
  /// Return the sheets, likewise; null without any.
  /// @throws std::runtime_error as Sheets::update()
  const Sheets* sheets();
  /// Return a light's stack. Some volume casts.
  const VolumeStack& stackOf(const LightPlan& light);
  /// Return those of an area light's points.
  const AreaStacks& areaStacksOf(const LightPlan& light);
  /// Have the frame's pointwise techniques see what volumes and sheets leave. Drops the stacks and
  /// maps of lights that are gone.
  void attach();

  /// Return the bytes of stacks and maps.
  std::size_t bytes() const
  {
    return bytesOfAll(this->ofLights_,
      [](const auto& of)
      {
        const OfLight& one = of.second;
        return (one.stack ? one.stack->bytes() : 0) + (one.ofArea ? one.ofArea->bytes() : 0) +
          (one.sheets ? one.sheets->bytes() : 0);
      });
  }
  std::size_t bytesOfSheets() const { return this->sheets_ ? this->sheets_->bytes() : 0; }

private:
  struct OfLight
  {
    RayIdentity light;
    int resolution = 0; ///< of the stacks
    int texels = 0;     ///< of the map
    ///@{
    /// Null until asked for.
    std::unique_ptr<VolumeStack> stack;
    std::unique_ptr<AreaStacks> ofArea;
    std::unique_ptr<VolumeTexture> texture; ///< of `stack`
    std::unique_ptr<SheetMap> sheets;
    ///@}
  };
  OfLight& find(const LightPlan& light);
  std::vector<const PointFilter*> filtersOf(const LightPlan& light);

  Frame& frame_;
  const Occluders& occluders_;
  Volumes volumes_;
  std::optional<Sheets> sheets_;    ///< none without translucent casters
  std::map<int, OfLight> ofLights_; ///< by ShadowLight::sceneIndex
};

} // namespace gnomon
