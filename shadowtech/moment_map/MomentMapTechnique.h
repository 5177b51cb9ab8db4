#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/moment_map/BoxBlur.h"
#include "shadowtech/moment_map/SampledLayer.h"
#include "shadowtech/moment_map/SummedAreaTable.h"

#include <utility>

namespace gnomon
{

/// How maps of moments are averaged.
enum class MapBlur
{
  Box, ///< when they are drawn, by a box that is the same on the whole map
  Sat ///< when they are read, by a summed-area table, over a rectangle that each look-up has of its own
};

/// How a map of moments is made, and what its bound is taken for: moments bound the lit share from
/// above, and a bound up to `bleeding` counts as shadow while the rest is spread over [0, 1].
struct MomentMapSettings
{
  double bleeding = 0.2;
  MapBlur blur = MapBlur::Box;
  bool mipMaps = false; ///< whether pixels that see many texels read coarser levels of the map
  int samples = 1;      ///< 1, 2, 4 or 8 samples of a texel, which are averaged
};
const SettingsTable& momentMapSettings();

/// An estimator over moments.
struct MomentEstimator
{
  TechniqueInfo info;
  int count; ///< of moments: 1, 2 or 4
  /// The file of vec4 momentsOf(float depth, float spread): the mean moments of depths around
  /// `depth`, in [-1, 1], with the standard deviation `spread`, in [0, 1]. Only the first `count`
  /// count.
  const char* momentsFile;
  /// The file of float estimate_LIGHT(ViewPoint point, float slack), which includes
  /// moment_map.glsl.
  const char* estimatorFile;
  glm::vec4 empty; ///< momentsOf(1, 0)
  /// What no moment's size exceeds, a power of two, for fixed-point numbers; 0: too much for them.
  glm::vec4 largest;
};

/// All techniques with a map of moments, which is filtered before it is read
/// (docs/techniques/vsm.md): by a box as wide as the light's kernel (BoxBlur.h), or with `blur` sat
/// by each look-up (SummedAreaTable.h), and by the texture unit's bilinear filter. Together they
/// are the bilinear kernel of `pcf` (Pcf.h).
///
/// The depth of moments is the map's linear depth, from [0, 1] to [-1, 1]. Texels without casters
/// have the moments of depth 1, and so has what lies outside of a layer.
///
/// **No bias is tuned.** A receiver is compared at its own depth, and where more than two moments
/// demand it, at one that follows from its plane (MomentEstimators.h). Of a plane, the
/// mean over the kernel's square is the depth at the square's middle, which is the receiver's:
/// parallel rays make depth linear on the map; in perspective it is convex along any line on the
/// map, so that its mean only lies farther away, which is on the lit side; and so it is on convex
/// surfaces. What is left is rounding of the positions on the map (the rasteriser's, and of the
/// texture unit's weights, which may be multiples of 1/256 texel). It moves depth in proportion to
/// the slope, as the square root of the variance is. A single texel has no variance of its own: its
/// depths are taken to be spread by half of what they change by to the next texel (Donnelly and
/// Lauritzen 2006, "derivative bias"). Where there is no slope, the estimators have a floor to the
/// variance.
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
  GlTexture map_;   ///< a layer for each view, or one that is drawn before it is summed
  GlTexture depth_; ///< of the layer that is being drawn with one sample
  GlFramebuffer framebuffer_;
  SampledLayer sampled_; ///< what it is drawn into with several
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
