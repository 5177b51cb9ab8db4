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

/// For any surface, two projections' ratio of areas equals that of the texels on it.
TEST(MapAliasing, OfAreasComparesProjectionsOnEverySurface)
{
  std::mt19937 random(41);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const glm::dmat3 one(0.013, 0.001, 0.0002, 0.002, 0.017, 0.0005, 0.3, -0.2, 1.5);
  const glm::dmat3 other(1.3);
  for (const LightRays& rays : { directionalRays({ 0.3, 0.5, -0.6 }),
         spotRays({ 300.0, -500.0, 400.0 }, { -1.0, 0.2, -1.0 }) })
  {
    const Setting setting = terrain(rays);
    const glm::dvec3 point(15.0, -400.0, 3.0);
    const glm::dmat4 centredFromView = glm::inverse(rays.viewFromCentred);
    const auto areaOn = [&](const glm::dmat3& map, const glm::dvec3& normal)
    {
      // Return the screen point at which the ray of a map point meets the surface.
      const auto screenOf = [&](const glm::dvec2& device)
      {
        const glm::dvec2 across = mapped(glm::inverse(map), device);
        const glm::dvec3 from(centredFromView *
          (rays.positional ? glm::dvec4(0.0, 0.0, 0.0, 1.0) : glm::dvec4(across, 0.0, 1.0)));
        const glm::dvec3 along(centredFromView *
          (rays.positional ? glm::dvec4(across, 1.0, 0.0) : glm::dvec4(0.0, 0.0, 1.0, 0.0)));
        const glm::dvec3 hit =
          from + along * (glm::dot(normal, point - from) / glm::dot(normal, along));
        const glm::dvec4 clip = setting.camera.clipFromCentred() * glm::dvec4(hit, 1.0);
        return glm::dvec2(clip) / clip.w;
      };
      const double step = 1e-5;
      const glm::dvec2 place = mapped(map, rays.across(inView(rays, point)));
      const glm::dmat2 sides(screenOf(place + glm::dvec2(step, 0.0)) - screenOf(place),
        screenOf(place + glm::dvec2(0.0, step)) - screenOf(place));
      return std::abs(glm::determinant(sides));
    };
    const auto aliasing = [&](const glm::dmat3& map)
    { return perspectiveAliasing({ inView(rays, point) }, setting.camera, rays, map).area; };
    for (int i = 0; i < 20; ++i)
    {
      const glm::dvec3 normal(uniform(random), uniform(random), 1.0);
      EXPECT_NEAR(
        areaOn(one, normal) / areaOn(other, normal) / (aliasing(one) / aliasing(other)), 1.0, 1e-2);
    }
  }
}

} // namespace
} // namespace gnomon::test
