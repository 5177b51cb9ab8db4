// Kernels on warped maps have an even shape across the light.

#include "EstimatorGlsl.h"

#include "lights/KernelShape.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/depth_map/KernelPoints.h"
#include "shadowtech/depth_map/Pcf.h"

#include <algorithm>
#include <cmath>

namespace gnomon::test
{
namespace
{

/// Return the views of the sun, warped. The eye is in front of the map's lower side: texels at the
/// upper side are (1 + 2 / eye)^2 as high, and 1 + 2 / eye as wide, as at the lower one.
LightViews warpedViews(const ShadowLight& light, double eye)
{
  LightViews views = sunViews(light);
  glm::dmat3& map = views.views.front().mapFromAcross;
  // y' = a + b / (y + 1 + eye), w = y + 1 + eye.
  const double n = eye;
  const double f = eye + 2.0;
  const glm::dmat3 warp(n, 0.0, 0.0, 0.0, (f + n) / (f - n), 1.0, 0.0,
    (f + n) / (f - n) * (1.0 + eye) - 2.0 * f * n / (f - n), 1.0 + eye);
  map = warp * map;
  return views;
}

ShadowLight warpedSun(const char* kernel, int texels)
{
  ShadowLight light = filteredSun(kernel, texels);
  light.projection = Projection::Lispsm;
  return light;
}

glm::dvec2 singularValues(const glm::dmat2& matrix)
{
  const double sum = glm::length(matrix[0]) * glm::length(matrix[0]) +
    glm::length(matrix[1]) * glm::length(matrix[1]);
  const double det = glm::determinant(matrix);
  const double root = std::sqrt(std::max(sum * sum / 4.0 - det * det, 0.0));
  return { std::sqrt(sum / 2.0 + root), std::sqrt(std::max(sum / 2.0 - root, 0.0)) };
}

/// The Jacobian with its area as unit: its longer axis is at most `limit` long.
glm::dmat2 evenShape(const glm::dmat2& jacobian, double limit)
{
  const glm::dmat2 wished = jacobian / std::sqrt(glm::determinant(jacobian));
  const double stretch = singularValues(wished).x;
  if (stretch <= limit)
  {
    return wished;
  }
  const glm::dmat2 squared = wished * glm::transpose(wished); // stretch^2 along the longer axis
  const glm::dmat2 along = (squared - glm::dmat2(1.0 / (stretch * stretch))) /
    (stretch * stretch - std::pow(stretch, -2.0));
  const double shorter = limit / stretch;
  return (shorter * along + (glm::dmat2(1.0) - along) / shorter) * wished;
}

TEST(KernelShape, jacobianIsTheDerivative)
{
  const ShadowLight light = warpedSun("bilinear", 3);
  const glm::dmat3 texels = texelFromAcross(warpedViews(light, 0.3).views.front(), mapSize);
  for (const glm::dvec2& at : { glm::dvec2(0.0), { 0.7, -0.8 }, { -0.5, 0.9 } })
  {
    const glm::dmat2 jacobian = texelJacobian(texels, at);
    constexpr double step = 1e-6;
    for (int i = 0; i < 2; ++i)
    {
      glm::dvec2 offset(0.0);
      offset[i] = step;
      const glm::dvec2 derivative =
        (mapped(texels, at + offset) - mapped(texels, at - offset)) / (2.0 * step);
      EXPECT_NEAR(glm::distance(derivative, jacobian[i]), 0.0, 1e-4);
    }
  }
}

using KernelShapeGlsl = GlslTest;

TEST_F(KernelShapeGlsl, weighsTexelsInTheKernelsShape)
{
  for (const double eye : { 0.2, 1.0 })
  {
    for (const int texels : { 1, 3, 6 })
    {
      const ShadowLight light = warpedSun("bilinear", texels);
      const LightViews views = warpedViews(light, eye);
      const glm::dmat3 texelsFromAcross = texelFromAcross(views.views.front(), mapSize);
      const std::vector<glm::dvec2> places =
        randomPlaces(40); // the stretched kernel is on the map, too
      const std::vector<float> values = runGlsl(Pcf(), light, views, scattered, places);
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        const glm::dvec2 across = mapped(glm::inverse(texelsFromAcross), places[i]);
        const glm::dmat2 kernelFromTexel =
          glm::inverse(evenShape(texelJacobian(texelsFromAcross, across), largestStretch(texels)));
        const double expected = litShare(scattered,
          [&](const glm::ivec2& texel)
          {
            const glm::dvec2 away = kernelFromTexel * (glm::dvec2(texel) + 0.5 - places[i]);
            const auto share = [&](double distance)
            { return glm::clamp(0.5 * (texels + 1) - std::abs(distance), 0.0, 1.0); };
            return share(away.x) * share(away.y);
          });
        ASSERT_NEAR(values[i], expected, 1e-3) << texels << " texels, place " << i;
      }
    }
  }
}

/// Turning keeps radii: a lit disk, in the kernel's shape, around a place holds as many points as
/// the table has within its radius, but for those that share a texel with its rim.
TEST_F(KernelShapeGlsl, poissonReadsATurnedDiscInTheKernelsShape)
{
  constexpr int texels = 28;
  const glm::dvec2 middle(32.1, 31.8);
  for (const bool warped : { false, true })
  {
    const ShadowLight light =
      warped ? warpedSun("poisson", texels) : filteredSun("poisson", texels);
    const LightViews views = warped ? warpedViews(light, 0.4) : sunViews(light);
    const glm::dmat3 map = texelFromAcross(views.views.front(), mapSize);
    const glm::dmat2 shape =
      evenShape(texelJacobian(map, mapped(glm::inverse(map), middle)), largestStretch(texels));
    EXPECT_TRUE(!warped || singularValues(shape).x > 1.5) << "the test says nothing";
    // Places in cells of their own around the middle.
    std::vector<glm::dvec2> places;
    for (int i = 0; i < 64; ++i)
    {
      places.push_back(middle + glm::dvec2(i % 8 - 4, i / 8 - 4) / 40.0);
    }
    for (const double radius : { 0.125 * texels, 0.25 * texels, 0.375 * texels, 0.47 * texels })
    {
      const Map outside = [&](const glm::ivec2& texel)
      { return glm::length(glm::inverse(shape) * (glm::dvec2(texel) + 0.5 - middle)) > radius; };
      const auto within = [&](double most)
      {
        return std::count_if(poissonDisc().begin(), poissonDisc().end(),
          [&](const glm::dvec2& point) { return 0.5 * texels * glm::length(point) < most; });
      };
      const double rim = 0.9 * singularValues(shape).x;
      double sum = 0.0;
      for (const float value : runGlsl(Pcf(), light, views, outside, places))
      {
        const double lit = value * poissonPoints;
        sum += lit;
        EXPECT_NEAR(lit, std::round(lit), 1e-4);
        EXPECT_GE(lit + 1e-3, within(radius - rim)) << radius;
        EXPECT_LE(lit - 1e-3, within(radius + rim)) << radius;
      }
      EXPECT_NEAR(sum / 64.0, within(radius), 0.1 * poissonPoints) << radius;
    }
  }
}

TEST_F(KernelShapeGlsl, aBoxOfAnyWidthHasOneLevelMoreThanTaps)
{
  // The survey's offset scale: the taps of a box lie farther apart than texels.
  const Map halfPlane = [](const glm::ivec2& texel) { return texel.x >= mapSize / 2; };
  for (const int texels : { 1, 3, 5, 11 })
  {
    for (const double scale : { 0.5, 1.0, 3.0 })
    {
      ShadowLight light = filteredSun("box", texels);
      const double texelAcross = 1.0 / mostTexelsAcross(sunViews(light), mapSize);
      light.kernel.widthAcross = scale * texels * texelAcross;
      std::vector<glm::dvec2> places;
      for (int i = 0; i < 6400; ++i)
      {
        places.emplace_back(0.01 * i, 32.3);
      }
      const std::vector<float> values = runGlsl(Pcf(), light, sunViews(light), halfPlane, places);
      std::vector<float> levels = values;
      std::sort(levels.begin(), levels.end());
      levels.erase(std::unique(levels.begin(), levels.end(),
                     [](float a, float b) { return std::abs(a - b) < 1e-5f; }),
        levels.end());
      EXPECT_EQ(levels.size(), static_cast<std::size_t>(texels) + 1)
        << texels << " taps, " << scale;
    }
  }
}

} // namespace
} // namespace gnomon::test
