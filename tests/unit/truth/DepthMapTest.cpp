// The contents of a depth map, read back: its metrics, biases and surfaces, and the pyramid of its
// bounds.

#include "EstimatorGlsl.h"
#include "SyntheticScene.h"

#include "lights/KernelShape.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/DepthMapTechnique.h"
#include "shadowtech/depth_map/Pcf.h"

#include <algorithm>
#include <cmath>

namespace gnomon::test
{
namespace
{

constexpr int mapSide = 128;

std::vector<float> readLayer(GLuint texture, GLenum format, int size, int level, int channels)
{
  std::vector<float> values(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) *
    static_cast<std::size_t>(channels));
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture);
  glGetTexImage(GL_TEXTURE_2D_ARRAY, level, format, GL_FLOAT, values.data());
  return values;
}

/// The map and its view, baked for a light with a single view.
template <typename Estimator>
class BakedDepths : public Estimator
{
public:
  BakedDepths(const ShadowLight& asked, const std::vector<Prop>& props, int side = mapSide)
    : light(withMap(asked, side))
  {
    const Occluders occluders = makeOccluders(props);
    this->views = fitLightViews(this->light,
      { occluders.frame.centre, occluders.allCentred, {},
        { side, this->mapReach(this->light).borderTexels() }, {} });
    OccluderBuffers buffers;
    buffers.update(occluders);
    ShaderLibrary shaders;
    this->bake({ this->light, this->views, occluders, buffers, shaders });
    this->centre = occluders.frame.centre;
    this->depths = readLayer(this->map().name(), GL_DEPTH_COMPONENT, side, 0, 1);
  }

  const LightView& view() const { return this->views.views.front(); }
  float at(int x, int y) const { return this->depths[static_cast<std::size_t>(y * mapSide + x)]; }
  /// Return the ray through a texel's centre, in the view's space, to distance 1.
  glm::dvec3 ray(int x, int y) const
  {
    const glm::dmat3 acrossFromTexel = glm::inverse(texelFromAcross(this->view(), mapSide));
    return { mapped(acrossFromTexel, glm::dvec2(x + 0.5, y + 0.5)), 1.0 };
  }

  ShadowLight light;
  LightViews views;
  glm::dvec3 centre{ 0.0 };
  std::vector<float> depths;
};

std::vector<Prop> floorAndBox()
{
  return { { makePlane(6.0) }, { makeBox({ -0.5, -0.5, 1.0 }, { 0.5, 0.5, 2.0 }) } };
}

using DepthMap = GlslTest;

TEST_F(DepthMap, euclideanDepthIsTheDistanceWhateverNearAndFarAre)
{
  // A sheet across the axis, so nothing is pushed back in the linear metric; and far casters that
  // move the far plane.
  for (const double farther : { 0.0, 10.0, 1000.0 })
  {
    for (const DepthSurface surface : { DepthSurface::First, DepthSurface::Second })
    {
      std::vector<Prop> props = { { makePlane(3.0) },
        { makePlane(0.5), at({ 0.0, 0.0, -1.0 - farther }) } };
      if (surface == DepthSurface::Second)
      {
        props = { { makeBox({ -1.5, -1.5, 0.0 }, { 1.5, 1.5, 0.5 }) },
          { makePlane(0.5), at({ 0.0, 0.0, -1.0 - farther }) } };
      }
      ShadowLight light = spotLight({ 0.0, 0.0, 4.0 }, glm::dvec3(0.0), 30.0);
      light.depthMap.metric = DepthMetric::Euclidean;
      light.depthMap.surface = surface;
      const BakedDepths<Compare> baked(light, props);
      int counted = 0;
      for (int y = 0; y < mapSide; y += 5)
      {
        for (int x = 0; x < mapSide; x += 5)
        {
          const glm::dvec3 ray = baked.ray(x, y);
          const glm::dvec2 onSheet = glm::dvec2(ray) * 4.0;
          if (std::max(std::abs(onSheet.x), std::abs(onSheet.y)) > 1.4)
          {
            continue;
          }
          ++counted;
          const double scale = baked.view().depthScale / longestRay(baked.view());
          EXPECT_NEAR(baked.at(x, y) / scale / (4.0 * glm::length(ray)), 1.0, 1e-5);
        }
      }
      EXPECT_GT(counted, 20);
    }
  }
}

TEST_F(DepthMap, constantBiasIsAddedInWorldUnits)
{
  for (const bool lamp : { false, true })
  {
    const ShadowLight plain = lamp ? spotLight({ 1.0, 0.5, 6.0 }, glm::dvec3(0.0), 40.0)
                                   : directionalLight({ 0.3, 0.2, -1.0 });
    ShadowLight biased = plain;
    biased.depthMap.biasConstant = 0.03;
    const BakedDepths<Compare> without(plain, floorAndBox());
    const BakedDepths<Compare> with(biased, floorAndBox());
    // Polygon offset pushes by the larger slope; the shader pushes by half of the slopes' sum.
    ShadowLight twice = biased;
    twice.depthMap.biasConstant = 0.06;
    const BakedDepths<Compare> withTwice(twice, floorAndBox());
    int casters = 0;
    for (std::size_t i = 0; i < with.depths.size(); ++i)
    {
      if (with.depths[i] < 0.85f)
      {
        ++casters;
        const double pushed = 0.03 * with.view().depthScale;
        EXPECT_NEAR(withTwice.depths[i] - with.depths[i], pushed, 2e-6);
        EXPECT_TRUE(!lamp || std::abs(with.depths[i] - without.depths[i] - pushed) < 2e-6);
      }
    }
    EXPECT_GT(casters, 1000);
  }
}

TEST_F(DepthMap, slopeBiasIsAFactorOnWhatASlopeSpans)
{
  // Only a floor; its depth has one slope.
  const auto pushedBy = [](double factor, ShadowLight light = directionalLight({ 0.6, 0.0, -1.0 }))
  {
    light.depthMap.biasSlope = factor;
    light.depthMap.biasConstant = 1e-9; // the shader then pushes in all cases
    const BakedDepths<Compare> baked(light, { { makePlane(6.0) } });
    return baked.at(mapSide / 2, mapSide / 2);
  };
  const double once = pushedBy(1.0) - pushedBy(0.0);
  EXPECT_GT(once, 1e-4);
  EXPECT_NEAR(pushedBy(3.0) - pushedBy(0.0), 3.0 * once, 1e-6);
  ShadowLight below = directionalLight({ 0.6, 0.0, 1.0 });
  const double first = pushedBy(0.0, below);
  below.depthMap.surface = DepthSurface::Second;
  EXPECT_NEAR(first - pushedBy(0.0, below), once, 1e-6)
    << "what faces away hides no light from itself";
}

TEST_F(DepthMap, holdsTheSurfaceThatIsAskedFor)
{
  // Straight above a box on a floor: its top at z = 2, its bottom at 1, the floor at 0.
  const auto heightsOf = [](DepthSurface surface, const std::vector<Prop>& props)
  {
    ShadowLight light = directionalLight({ 0.0, 0.0, -1.0 });
    light.depthMap.surface = surface;
    const BakedDepths<Compare> baked(light, props);
    const auto height = [&](int x, int y)
    {
      const double depth = baked.at(x, y);
      return depth >= 1.0 ? -100.0
                          : 2.0 - (depth - baked.view().depthOffset) / baked.view().depthScale;
    };
    return glm::dvec2(height(mapSide / 2, mapSide / 2), height(8, 8));
  };
  const std::vector<Prop> props = floorAndBox();
  EXPECT_NEAR(glm::distance(heightsOf(DepthSurface::First, props), { 2.0, 0.0 }), 0.0, 1e-5);
  // The floor is open: it faces the light, and none of it faces away.
  EXPECT_NEAR(glm::distance(heightsOf(DepthSurface::Second, props), { 1.0, -100.0 }), 0.0, 1e-5);
  // Alone it is not pushed back.
  EXPECT_NEAR(glm::distance(heightsOf(DepthSurface::Midpoint, props), { 1.5, 0.0 }), 0.0, 1e-5);
  // Under the box lies the box's bottom, not the floor. One-sided casters have only their front.
  std::vector<Prop> oneSided = props;
  oneSided[1].oneSided = true;
  EXPECT_NEAR(heightsOf(DepthSurface::Second, oneSided).x, 2.0, 1e-5);
  EXPECT_NEAR(heightsOf(DepthSurface::Midpoint, oneSided).x, 1.0, 1e-5);
}

struct Adaptive : Pcf
{
  Adaptive()
    : Pcf(Kernel::JitteredDisc)
  {
  }
};

TEST_F(DepthMap, pyramidBoundsEveryBlock)
{
  for (const int size : { 16, 64, 100, 127, 129 })
  {
    const BakedDepths<Adaptive> baked(directionalLight({ 0.3, 0.2, -1.0 }), floorAndBox(), size);
    GLuint bounds = 0;
    for (const Uniform& uniform : baked.uniforms({}))
    {
      if (uniform.name == "depthBounds_LIGHT")
      {
        bounds = std::get<TextureBinding>(uniform.value).texture;
      }
    }
    ASSERT_NE(bounds, 0u);
    int blocks = 1;
    while (2 * blocks < size)
    {
      blocks *= 2;
    }
    for (int level = 0; blocks >= 1; blocks /= 2, ++level)
    {
      const std::vector<float> ranges = readLayer(bounds, GL_RG, blocks, level, 2);
      const int extent = 2 << level;
      for (int block = 0; block < blocks * blocks; ++block)
      {
        float least = 1.0f;
        float largest = 0.0f;
        for (int texel = 0; texel < extent * extent; ++texel)
        {
          const int x = (block % blocks) * extent + texel % extent;
          const int y = (block / blocks) * extent + texel / extent;
          const float depth =
            x < size && y < size ? baked.depths[static_cast<std::size_t>(y * size + x)] : 1.0f;
          least = std::min(least, depth);
          largest = std::max(largest, depth);
        }
        ASSERT_EQ(ranges[static_cast<std::size_t>(2 * block)], least) << size << ", " << level;
        ASSERT_EQ(ranges[static_cast<std::size_t>(2 * block + 1)], largest)
          << size << ", " << level;
      }
    }
  }
}

} // namespace
} // namespace gnomon::test
