#include "lights/LightSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::test
{
namespace
{

const glm::dvec3 centre(10.0, 20.0, 30.0);

ShadowLight lightOf(LightKind kind)
{
  ShadowLight light;
  light.kind = kind;
  light.positionWorld = { 11.0, 22.0, 33.0 };
  light.directionWorld = glm::normalize(glm::dvec3(1.0, -2.0, -0.5));
  light.coneAngleDegrees = 30.0;
  light.lightRadius = 0.5;
  light.lightSamples = 256;
  return light;
}

TEST(LightSamples, ofAHardLightAreItsPlace)
{
  for (const LightKind kind : { LightKind::Directional, LightKind::Spot, LightKind::Point })
  {
    ShadowLight light = lightOf(kind);
    light.lightRadius = 0.0;
    const std::vector<glm::dvec4> samples = lightSamples(light, centre);
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0], lightPoint(light, centre));
  }
  EXPECT_EQ(lightPoint(lightOf(LightKind::Point), centre), glm::dvec4(1.0, 2.0, 3.0, 1.0));
  const glm::dvec4 sun = lightPoint(lightOf(LightKind::Directional), centre);
  EXPECT_NEAR(
    glm::distance(glm::dvec3(sun), -lightOf(LightKind::Point).directionWorld), 0.0, 1e-15);
  EXPECT_EQ(sun.w, 0.0);
}

TEST(LightSamples, fillADiscAcrossTheLight)
{
  for (const LightKind kind : { LightKind::Directional, LightKind::Spot })
  {
    const ShadowLight light = lightOf(kind);
    const glm::dvec3 middle(lightPoint(light, centre));
    glm::dvec3 mean(0.0);
    int inner = 0;
    for (const glm::dvec4& sample : lightSamples(light, centre))
    {
      glm::dvec3 offset = glm::dvec3(sample) - middle;
      if (kind == LightKind::Directional)
      {
        // The radius is the tangent of the angle.
        EXPECT_NEAR(glm::length(glm::dvec3(sample)), 1.0, 1e-12);
        offset = glm::dvec3(sample) / glm::dot(glm::dvec3(sample), middle) - middle;
      }
      EXPECT_NEAR(glm::dot(offset, light.directionWorld), 0.0, 1e-12);
      EXPECT_LE(glm::length(offset), 0.5);
      inner += glm::length(offset) < 0.5 * std::sqrt(0.5) ? 1 : 0;
      mean += offset / 256.0;
    }
    EXPECT_EQ(inner, 128) << "half of the area";
    EXPECT_LT(glm::length(mean), 0.01);
  }
}

TEST(LightSamples, ofALampLookLikeAnEvenDiscFromAllSides)
{
  ShadowLight light = lightOf(LightKind::Point);
  light.lightSamples = 1024;
  for (const glm::dvec3& axis :
    { glm::dvec3(1.0, 0.0, 0.0), { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 0.48, -0.6, 0.64 } })
  {
    for (const double share : { 0.1, 0.25, 0.5, 0.75, 0.9 })
    {
      int inside = 0;
      for (const glm::dvec4& sample : lightSamples(light, centre))
      {
        const glm::dvec3 offset = glm::dvec3(sample) - glm::dvec3(1.0, 2.0, 3.0);
        inside +=
          glm::length(offset - glm::dot(offset, axis) * axis) < 0.5 * std::sqrt(share) ? 1 : 0;
        EXPECT_LE(glm::length(offset), 0.5);
      }
      EXPECT_NEAR(inside / 1024.0, share, 0.02);
    }
  }
}

TEST(LightSamples, areTheSameAtEveryCallAndAllDiffer)
{
  for (const LightKind kind : { LightKind::Directional, LightKind::Spot, LightKind::Point })
  {
    for (const int count : { 1, 2, 3, 33, 1024 })
    {
      ShadowLight light = lightOf(kind);
      light.lightSamples = count;
      const std::vector<glm::dvec4> samples = lightSamples(light, centre);
      ASSERT_EQ(samples.size(), static_cast<std::size_t>(count));
      EXPECT_EQ(samples, lightSamples(light, centre));
      for (std::size_t i = 0; i < samples.size(); ++i)
      {
        EXPECT_TRUE(std::isfinite(glm::dot(samples[i], samples[i])));
        EXPECT_EQ(std::count(samples.begin(), samples.end(), samples[i]), 1);
      }
    }
  }
}

} // namespace
} // namespace gnomon::test
