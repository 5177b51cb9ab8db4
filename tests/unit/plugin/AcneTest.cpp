// Unoccluded receivers are lit: scenes without a shadow, by every technique.

#include "PassScene.h"
#include "Variant.h"

using namespace gnomon::test;

namespace
{

/// From a receiver towards the light; zero where the light does not shine.
using ToLight = std::function<glm::dvec3(const glm::dvec3&)>;

ToLight towardsLamp(const glm::dvec3& light)
{
  return [=](const glm::dvec3& point) { return light - point; };
}

/// The least visibility that maps of moments may give unoccluded receivers. All other techniques
/// light them fully.
struct OfMoments
{
  double mean;
  double least;
};

struct LitScenes : PassTestOf<Variant>
{
  static void choose(PassScene& scene) { GetParam().choose(scene); }
  /// Without a floor of variance, so slopes are lit by the technique's own means.
  static void chooseWithoutFloor(PassScene& scene)
  {
    choose(scene);
    GetParam().set(scene.pass, "variance_floor", "1e-9");
  }

  /// Do something with maps of each of the sizes that the technique takes for these.
  template <typename Action>
  static void withMaps(PassScene& scene, const std::vector<int>& sizes, const Action& action)
  {
    for (const int mapSize : GetParam().mapSizes(sizes))
    {
      SCOPED_TRACE("map " + std::to_string(mapSize));
      GetParam().set(scene.pass, "map_size", std::to_string(mapSize));
      action(mapSize);
    }
  }

  static void expectLit(PassScene& scene, const ToLight& toLight, std::size_t facing,
    const OfMoments& ofMoments, double leastCosine = 0.0, float least = 1.0f)
  {
    const Acne acne = countAcne(drawKept(scene), toLight, leastCosine);
    EXPECT_GT(acne.facing, facing);
    if (GetParam().isMoments())
    {
      EXPECT_GE(acne.mean, ofMoments.mean) << "least " << acne.least;
      EXPECT_GE(acne.least, ofMoments.least) << "mean " << acne.mean;
    }
    else
    {
      EXPECT_GE(acne.least, least) << acne.dark << " are dark";
    }
  }
  static void expectLitBySun(PassScene& scene, const glm::dvec3& toLight, std::size_t facing,
    const OfMoments& ofMoments, double leastCosine = 0.0)
  {
    SCOPED_TRACE(testing::PrintToString(std::vector{ toLight.x, toLight.y, toLight.z }));
    aim(lightOf(scene.renderer), toLight);
    expectLit(
      scene, [=](const glm::dvec3&) { return toLight; }, facing, ofMoments, leastCosine);
  }
};

bool hasPlainKernel(const Variant& variant)
{
  return !variant.isMoments() || variant.text.find("kernel_size") == std::string::npos;
}

/// For lamps that see all around. The largest ones would intersect the floors that they light.
bool isForLamps(const Variant& variant)
{
  return variant.takesCubes() && hasPlainKernel(variant) && !variant.hasSetting("light_radius=4") &&
    !variant.hasSetting("light_radius=10") && variant.text != "montecarlo light_radius=0.5";
}

/// For lamps whose light walls never hide: without an area. Layers treat a closed room as solid.
bool isForRooms(const Variant& variant)
{
  return isForLamps(variant) && variant.text.find("light_radius") == std::string::npos &&
    !has(variant.info(), "mc_layers");
}

/// Exclusions: moments bleed in corners, layers treat enclosed space as solid, and walls hide a
/// part of the largest sun.
bool isForCorners(const Variant& variant)
{
  return !variant.isMoments() && !variant.hasSetting("light_radius=10") &&
    !has(variant.info(), "mc_layers");
}

/// Return a direction at `degrees` from the floor's normal, and turned around it.
glm::dvec3 slantingBy(double degrees, double turnDegrees)
{
  const double angle = glm::radians(degrees);
  const double turn = glm::radians(turnDegrees);
  return { std::cos(turn) * std::sin(angle), std::sin(turn) * std::sin(angle), std::cos(angle) };
}

} // namespace

TEST_BY_VARIANTS(LitScenes, PlaneUnderTheSun, isForAll)
{
  PassScene scene(200, 200);
  scene.addFloor(4.0);
  scene.addSun({ 0.0, 0.0, -1.0 });
  this->chooseWithoutFloor(scene);
  scene.lookFrom({ 1.0, -7.0, 6.0 });
  this->withMaps(scene, { 64, 1024 },
    [&](int)
    {
      for (const double degrees : { 0.0, 0.01, 5.0, 60.0, 85.0, 88.0, 89.0 })
      {
        // Texels are not aligned with edges.
        this->expectLitBySun(scene, slantingBy(degrees, 36.87), 10000, { 0.999, 0.9 });
      }
    });
}

/// A plane seen along itself from its near end, where views are strongly warped.
TEST_BY_VARIANTS(LitScenes, LongPlane, isForAll)
{
  PassScene scene(150, 150);
  scene.addFloor(100.0);
  scene.addSun({ 0.0, 0.0, -1.0 });
  this->chooseWithoutFloor(scene);
  scene.lookFrom({ 3.0, -98.0, 2.0 }, { 0.0, 0.0, 0.0 });
  // A warp makes the plane's depths a hyperbola, whose mean may lie before the receiver. For a
  // kernel a quarter as wide as the map, that costs 0.014 at most. The rectangle that keeps a
  // kernel of 3 texels even is 6 texels long there.
  const double mean = GetParam().hasSetting("kernel_size=16") ? 0.985
    : GetParam().hasSetting("blur=sat")                       ? 0.998
                                                              : 0.999;
  this->withMaps(scene, { 64, 256 },
    [&](int)
    {
      for (const auto& [degrees, turn] :
        { std::pair(5.0, 10.0), { 5.0, 190.0 }, { 60.0, 80.0 }, { 60.0, 260.0 }, { 85.0, 10.0 },
          { 85.0, 80.0 }, { 85.0, 190.0 }, { 85.0, 260.0 }, { 89.0, 10.0 }, { 89.0, 260.0 } })
      {
        this->expectLitBySun(scene, slantingBy(degrees, turn), 5000, { mean, 0.0 });
      }
    });
}

/// Receivers are rounded by parts of a texel, and the map's levels are coarse.
TEST_BY_VARIANTS(LitScenes, PlaneFromFarAway, isForAll)
{
  PassScene scene(150, 150);
  scene.addFloor(4.0);
  scene.addSun({ 0.0, 0.0, -1.0 });
  this->chooseWithoutFloor(scene);
  for (const double times : { 4.0, 16.0, 100.0 })
  {
    const bool isNarrow = times == 100.0;
    if (!isNarrow && !GetParam().isMoments())
    {
      continue; // coarse levels of the map
    }
    SCOPED_TRACE(times);
    scene.lookFrom(times * glm::dvec3(1.0, -7.0, 6.0));
    scene.renderer->GetActiveCamera()->SetViewAngle(isNarrow ? 60.0 / times : 30.0);
    scene.renderer->ResetCameraClippingRange();
    for (const double degrees : { 0.0, 30.0, 85.0 })
    {
      this->expectLitBySun(scene, slantingBy(degrees, 36.87), isNarrow ? 5000 : 10, { 0.999, 0.0 });
    }
  }
}

TEST_BY_VARIANTS(LitScenes, PlaneUnderASpotLight, hasPlainKernel)
{
  PassScene scene(200, 200);
  scene.addFloor(4.0);
  scene.lookFrom({ 1.0, -7.0, 6.0 });
  vtkLight* const spot = scene.addSpot({ 0.0, 0.0, 3.0 }, glm::dvec3(0.0), 50.0);
  this->choose(scene);
  for (const double cone : { 50.0, GetParam().takesCubes() ? 80.0 : 60.0 })
  {
    spot->SetConeAngle(cone);
    this->withMaps(scene, { 64, 1024 },
      [&](int mapSize)
      {
        for (const double height : { cone == 50.0 ? 3.0 : 1.0, cone == 50.0 ? 0.3 : 0.1 })
        {
          SCOPED_TRACE(testing::Message() << "cone " << cone << ", height " << height);
          // The visible rest of a lamp that the floor cuts loses a hundredth in single pixels.
          const bool isCut = GetParam().technique() == "montecarlo" &&
            GetParam().hasSetting("light_radius=0.5") && height < 0.5;
          const glm::dvec3 light(-3.0, -2.0, height);
          aim(spot, light);
          // Half a degree inside the cone, so rounding does not decide.
          const double inside = std::cos(glm::radians(cone - 0.5));
          const ToLight toLight = [=](const glm::dvec3& point)
          {
            const bool isInCone =
              glm::dot(glm::normalize(point - light), glm::normalize(-light)) > inside;
            return isInCone ? light - point : glm::dvec3(0.0);
          };
          this->expectLit(
            scene, toLight, 5000, { 0.99, mapSize == 64 ? 0.6 : 0.7 }, 0.0, isCut ? 0.99f : 1.0f);
        }
      });
  }
}

/// When the light is lowest, its angle at a corner of the floor is 89.3 degrees. A tilted plane is
/// askew to the faces of the cube.
TEST_BY_VARIANTS(LitScenes, PlaneUnderAPointLight, isForLamps)
{
  PassScene scene(200, 200);
  vtkActor* const floor = scene.addFloor(4.0);
  scene.addBox({ -0.1, -0.1, 9.0 }, { 0.1, 0.1, 9.1 }); // so the scene is more than a plane
  vtkLight* const lamp = scene.addSpot({ 0.0, 0.0, 1.0 }, glm::dvec3(0.0), allDirections);
  this->choose(scene);
  scene.lookFrom({ 1.0, -7.0, 12.0 });
  for (const double tilt : { 0.0, 35.0 })
  {
    vtkNew<vtkTransform> turn;
    turn->RotateWXYZ(tilt, 1.0, 0.6, 0.2);
    floor->SetUserTransform(turn);
    this->withMaps(scene, { 64, 1024 },
      [&](int)
      {
        for (const double height : { tilt == 0.0 ? 8.0 : 1.0, 0.3, 0.07 })
        {
          SCOPED_TRACE(testing::Message() << "height " << height << ", tilted by " << tilt);
          const double along[3] = { 0.1, 0.2, height };
          const glm::dvec3 place = glm::make_vec3(turn->TransformDoublePoint(along));
          aim(lamp, place);
          this->expectLit(scene, towardsLamp(place), 5000, { 0.98, 0.6 });
        }
      });
  }
}

/// Convex: every surface that faces the light is lit. Within a texel of the terminator, the map
/// cannot tell.
TEST_BY_VARIANTS(LitScenes, ConvexSphere, hasPlainKernel)
{
  PassScene scene(300, 300);
  scene.addSphere(glm::dvec3(0.0), 1.0);
  scene.addSun({ 0.0, 0.0, -1.0 });
  this->choose(scene);
  scene.lookFrom({ -2.0, -2.0, 3.0 });
  this->withMaps(scene, { 64, 256, 1024 },
    [&](int mapSize) {
      this->expectLitBySun(scene, { -1.0, -0.4, 1.5 }, 20000, { 0.999, 0.9 }, 4.0 / mapSize + 0.05);
    });
}

/// From the box's middle, the borders of the cube's faces run along the box's edges.
TEST_BY_VARIANTS(LitScenes, InsideOfABox, isForRooms)
{
  PassScene scene(200, 200);
  scene.addBox(glm::dvec3(-2.0), glm::dvec3(2.0));
  vtkLight* const lamp = scene.addSpot(glm::dvec3(0.0), { 0.0, 0.0, -1.0 }, allDirections);
  this->choose(scene);
  for (const glm::dvec3& light : { glm::dvec3(0.0), { 0.7, -0.4, 0.9 }, { -1.9, 1.9, -1.9 } })
  {
    SCOPED_TRACE(light.x);
    lamp->SetPosition(light.x, light.y, light.z);
    this->withMaps(scene, { 32, 256 },
      [&](int mapSize)
      {
        const double corner = mapSize == 32 ? 1.9 : -1.9;
        scene.lookFrom({ corner, 0.95 * corner, corner });
        scene.renderer->GetActiveCamera()->SetViewAngle(100.0);
        scene.renderer->GetActiveCamera()->SetClippingRange(0.01, 10.0);
        this->expectLit(scene, towardsLamp(light), 39999, { 0.85, 0.0 });
      });
  }
}

/// A floor and two walls without thickness, under a sun inside the trough, from near and through a
/// long lens. The lens is so far away that positions are rounded by a good part of a texel. The
/// receiver's plane is extrapolated from there to the kernel's end.
TEST_BY_VARIANTS(LitScenes, Trough, isForCorners)
{
  PassScene scene(200, 200);
  scene.addFloor(2.0);
  for (const glm::dvec2& side : { glm::dvec2(-1.0, 0.0), { 0.0, -1.0 } })
  {
    vtkNew<vtkTransform> stand;
    stand->Translate(2.0 * side.x, 2.0 * side.y, 2.0);
    stand->RotateWXYZ(90.0, side.y, -side.x, 0.0);
    scene.addFloor(2.0)->SetUserTransform(stand);
  }
  scene.addSun({ 0.0, 0.0, -1.0 });
  this->choose(scene);
  vtkCamera* const camera = scene.renderer->GetActiveCamera();
  for (const double distance : { 14.0, 1000.0, 10000.0 })
  {
    scene.lookFrom(distance * glm::normalize(glm::dvec3(8.0, 9.0, 7.0)));
    camera->SetViewAngle(distance > 14.0 ? 2.0 * glm::degrees(std::atan(4.0 / distance)) : 30.0);
    camera->SetClippingRange(std::max(distance - 20.0, 0.1), distance + 20.0);
    SCOPED_TRACE(distance);
    this->withMaps(scene, { distance == 10000.0 ? 1024 : 256, distance == 14.0 ? 64 : 1024 },
      [&](int)
      {
        for (const glm::dvec3& toLight :
          { glm::dvec3(1.0, 0.8, 1.0), { 0.3, 1.0, 0.1 }, { 0.1, 0.1, 1.0 } })
        {
          this->expectLitBySun(scene, toLight, 5000, {});
        }
      });
  }
}

/// A hillside beyond a plain, seen along the plain. In warped views, the texels that a filter reads
/// beyond the valley differ in size from those of the point.
TEST_BY_VARIANTS(LitScenes, ValleyAcrossTheView, isForCorners)
{
  for (const double valley : { -90.0, -60.0, 0.0 })
  {
    const double top = 0.3 * (100.0 - valley);
    const auto land =
      meshOf({ { -100.0, -100.0, 0.0 }, { 100.0, -100.0, 0.0 }, { -100.0, valley, 0.0 },
               { 100.0, valley, 0.0 }, { -100.0, 100.0, top }, { 100.0, 100.0, top } },
        { { 0, 1, 3, 2 }, { 2, 3, 5, 4 } });
    PassScene scene(150, 150);
    this->choose(scene);
    scene.add(land.Get());
    scene.addSun({ 0.0, 0.0, -1.0 });
    scene.lookFrom({ 3.0, -98.0, 2.0 }, { 0.0, 0.0, 10.0 });
    SCOPED_TRACE(valley);
    this->withMaps(scene, { 64, 256 },
      [&](int)
      {
        for (const glm::dvec3& toLight :
          { glm::dvec3(0.0, -0.3, 1.0), { 0.0, 1.0, 1.0 }, { -1.0, -0.3, 0.5 }, { 1.0, 0.2, 0.6 } })
        {
          this->expectLitBySun(scene, toLight, 5000, {});
        }
      });
  }
}
