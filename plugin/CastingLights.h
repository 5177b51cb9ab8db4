#ifndef gnomon_plugin_CastingLights_h
#define gnomon_plugin_CastingLights_h

#include "lights/LightManager.h"
#include "plugin/LightTechnique.h"
#include "plugin/ShownView.h"
#include "shadowtech/base/FrameReport.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

class vtkRenderer;

namespace gnomon
{

/// A setting that cannot be served. The frame is drawn without shadows, with this as its error.
class FrameError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A light that casts in this frame, and what shades it.
struct CastingLight
{
  ShadowLight light;
  LightTechnique own;
  /// Shades translucent surfaces where the light's own technique works on the screen; none without such.
  std::optional<LightTechnique> plain;
  int layer = 0;    ///< of the visibility layers, its first
  int channels = 1; ///< of its visibility, a layer each

  /// What the shader computes the light's visibility with on a route; null if it only fetches. From here on there is a
  /// plain technique where one is needed.
  /// @param translucentReceivers whether translucent surfaces receive
  const Technique* pointwiseOn(Route route, bool translucentReceivers);
};

/// The lights stage: which of a renderer's lights cast, in the scene's order, each with the technique that it keeps for as
/// long as it asks for the same estimator.
class CastingLights
{
public:
  /// Reads the lights as they are now, and says of each in the report what becomes of it.
  /// @throws FrameError for techniques that do not exist or make no sense; the lights stay those of the frame before then
  void collect(vtkRenderer* renderer, const ShadowSettings& defaults, FrameReport& report);

  bool empty() const { return this->lights_.empty(); }
  std::vector<CastingLight>::iterator begin() { return this->lights_.begin(); }
  std::vector<CastingLight>::iterator end() { return this->lights_.end(); }
  std::vector<CastingLight>::const_iterator begin() const { return this->lights_.begin(); }
  std::vector<CastingLight>::const_iterator end() const { return this->lights_.end(); }

  /// Whether any of their techniques is such a one.
  template <typename IsSuch>
  bool anyTechnique(const IsSuch& isSuch) const
  {
    return std::any_of(this->lights_.begin(), this->lights_.end(),
      [&](const CastingLight& casting) { return isSuch(casting.own.info()); });
  }

  /// How many visibility layers they fill.
  int layers() const;

private:
  CastingLight take(ShadowLight light, const EstimatorEntry& estimator);

  LightManager manager_;
  ViewCount viewCount_;
  std::vector<CastingLight> lights_; ///< by their place in the scene
};

/// What the report says of a light that it has.
LightReport& reportOf(FrameReport& report, const ShadowLight& light);

} // namespace gnomon

#endif
