#include "FittedViews.h"

#include "lights/MapWarp.h"

namespace gnomon::test
{
namespace
{

/// Apelles, eq. 3.17, for a map whose texels are as wide as the pixels are at distance 1.
TEST(MapAliasing, OfASurfaceAcrossViewAndLightIsOneOverTheDistance)
{
  const LightRays rays = directionalRays({ 0.0, 1.0, 0.0 });
  const CameraView camera = perspectiveCamera(glm::dvec3(0.0), { 0.0, 1.0, 0.0 }, 90.0, 0.1, 100.0);
  for (const double distance : { 0.5, 1.0, 4.0, 50.0 })
  {
    const auto texel = texelPixels({ { 0.0, distance, 0.0 }, { 0.0, -1.0, 0.0 } }, camera,
      { 100.0, 100.0 }, rays, glm::dmat3(1.0), 100);
    ASSERT_TRUE(texel);
    EXPECT_NEAR(texel->x, 1.0 / distance, 1e-12);
    EXPECT_NEAR(texel->y, 1.0 / distance, 1e-12);
    const auto aliasing =
      perspectiveAliasing({ inView(rays, { 0.0, distance, 0.0 }) }, camera, rays, glm::dmat3(1.0));
    EXPECT_NEAR(aliasing.side, 1.0 / distance, 1e-12);
    EXPECT_NEAR(aliasing.area, 1.0 / (distance * distance), 1e-12);
  }
}

TEST(MapAliasing, OfAPositionalLightStandsAcrossItsRay)
{
  // The ray is at 45 degrees along x, so a step of the slope x / z moves at an angle to it.
  const LightRays rays{ glm::dmat4(1.0), true };
  const CameraView camera =
    perspectiveCamera({ 2.0, -5.0, 2.0 }, { 2.0, 0.0, 2.0 }, 60.0, 1.0, 9.0);
  const auto aliasing = [&](const glm::dmat3& map) {
    return perspectiveAliasing({ { 2.0, 0.0, 2.0 } }, camera, rays, map);
  };
  const double root = std::sqrt(0.5);
  EXPECT_NEAR(aliasing(glm::dmat3(1.0)).side, 2.0 / 5.0, 1e-12); // along y
  EXPECT_NEAR(aliasing(glm::dmat3(1.0)).area, root * 4.0 / 25.0, 1e-12);
  const glm::dmat3 fineAlongY(1.0, 0.0, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0, 1.0);
  EXPECT_NEAR(aliasing(fineAlongY).side, root * 2.0 / 5.0, 1e-12);
}

} // namespace
} // namespace gnomon::test
