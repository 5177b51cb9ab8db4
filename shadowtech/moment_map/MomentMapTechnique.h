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
/// No bias is tuned: docs/theory/moment_maps.md says why.
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
  SizedTexture map_;   ///< a layer per view; with summed-area tables, one layer before it is summed
  SizedTexture depth_; ///< of the layer being baked, with one sample per texel
  GlFramebuffer framebuffer_;
  SampledLayer sampled_; ///< the layer being baked, if it has several samples per texel
  BoxBlur blur_;
  SummedAreaTable table_;
  MapReach reach_;          ///< as baked
  bool summed_ = false;     ///< as baked
  LightViews views_;        ///< as baked
  TextureBinding viewFits_; ///< as baked
};

} // namespace gnomon
