#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/moment_map/BoxBlur.h"
#include "shadowtech/moment_map/SampledLayer.h"
#include "shadowtech/moment_map/SummedAreaTable.h"

#include <utility>

namespace gnomon
{

/// An estimator over moments.
struct MomentEstimator
{
  TechniqueInfo info;
  int count; ///< number of moments: 1, 2 or 4
  /// File of vec4 momentsOf(float depth, float spread). It returns mean moments of depths around
  /// `depth`, in [-1, 1], with standard deviation `spread`, in [0, 1]. Only the first `count`
  /// components count.
  const char* momentsFile;
  /// File of float estimate_LIGHT(ViewPoint point, float slack), which includes moment_map.glsl.
  const char* estimatorFile;
  glm::vec4 empty; ///< momentsOf(1, 0)
  /// A power of two that no moment exceeds in size, for fixed-point numbers; 0 if they cannot hold
  /// it.
  glm::vec4 largest;
};

/// The techniques with a map of moments, which is filtered before it is read
/// (docs/techniques/vsm.md). The filter is a box as wide as the light's kernel (BoxBlur.h), or one
/// rectangle per lookup with `blur` sat (SummedAreaTable.h). The texture unit's bilinear filter
/// adds to it. Together they are the bilinear kernel of `pcf` (Pcf.h).
///
/// The depth of moments is the map's linear depth, from [0, 1] to [-1, 1]. Texels without casters,
/// and those outside a layer, have the moments of depth 1.
///
/// **No bias is tuned.** A receiver is compared at its own depth. Where more than two moments
/// demand it, it is compared at a depth that follows from its plane (MomentEstimators.h). The mean
/// of a plane's depths over the kernel's square is the depth at the square's middle, which is the
/// receiver's. Parallel rays make depth linear on the map. In perspective it is convex along any
/// line on the map, so its mean only lies farther, which is on the lit side. The same holds for
/// convex surfaces.
///
/// The rest is rounding of positions on the map. It comes from the rasterizer, and from the
/// texture unit's weights, which may be multiples of 1/256 texel. It moves depth in proportion to
/// the slope, like the square root of the variance. A single texel has no variance of its own. So
/// its depths count as spread by half of their change to the next texel (Donnelly and Lauritzen
/// 2006, "derivative bias"). For flat parts, the estimators have a floor to the variance.
class MomentMapTechnique : public PointwiseTechnique
{
public:
  explicit MomentMapTechnique(MomentEstimator estimator)
    : estimator_(std::move(estimator))
  {
  }

  MapReach mapReach(const ShadowLight& light) const override;
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  std::string visibilityGlsl(const ShadowLight& light) const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

private:
  void allocate(const ShadowLight& light, int views);
  double widestKernel() const;

  MomentEstimator estimator_;
  GlTexture map_;   ///< a layer per view; with summed-area tables, one layer before it is summed
  GlTexture depth_; ///< of the layer being baked, with one sample per texel
  GlFramebuffer framebuffer_;
  SampledLayer sampled_; ///< the layer being baked, if it has several samples per texel
  BoxBlur blur_;
  SummedAreaTable table_;
  int sizeTexels_ = 0;
  int layers_ = 0; ///< of map_
  int levels_ = 0; ///< of map_
  int samples_ = 0;
  MapReach reach_;          ///< as baked
  bool summed_ = false;     ///< as baked
  LightViews views_;        ///< as baked
  TextureBinding viewFits_; ///< as baked
};

} // namespace gnomon
