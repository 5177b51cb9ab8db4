// Unoccluded receivers are lit: scenes without a shadow, by every technique.

#include "PassScene.h"
#include "Variant.h"

using namespace gnomon::test;

namespace
{

/// From a receiver towards the light; zero where the light does not shine.
using ToLight = std::function<glm::dvec3(const glm::dvec3&)>;

ToLight towardsSun(const glm::dvec3& toLight)
{
  return [=](const glm::dvec3&) { return toLight; };
}

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

  static void expectLit(PassScene& scene, const ToLight& toLight, std::size_t facing,
    const OfMoments& ofMoments, const std::string& where, double leastCosine = 0.0,
    float least = 1.0f)
  {
    const Acne acne = countAcne(drawKept(scene), toLight, leastCosine);
    EXPECT_GT(acne.facing, facing) << where;
    if (GetParam().isMoments())
    {
      EXPECT_GE(acne.mean, ofMoments.mean) << where << ", least " << acne.least;
      EXPECT_GE(acne.least, ofMoments.least) << where << ", mean " << acne.mean;
    }
    else
    {
      EXPECT_GE(acne.least, least) << where << ", " << acne.dark << " are dark";
    }
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

std::string textOf(const glm::dvec3& vector)
{
  return std::to_string(vector.x) + " " + std::to_string(vector.y) + " " + std::to_string(vector.z);
}

void placeSun(vtkLight* sun, const glm::dvec3& toLight)
{
  sun->SetPosition(toLight.x, toLight.y, toLight.z);
}

} // namespace

TEST_BY_VARIANTS(LitScenes, PlaneUnderTheSun, isForAll)
{
  PassScene scene(200, 200);
  scene.addFloor(4.0);
  vtkLight* const sun = scene.addSun({ 0.0, 0.0, -1.0 });
  this->chooseWithoutFloor(scene);
  scene.lookFrom({ 1.0, -7.0, 6.0 });
  for (const int mapSize : GetParam().mapSizes({ 64, 1024 }))
  {
    GetParam().set(scene.pass, "map_size", std::to_string(mapSize));
    for (const double degrees : { 0.0, 0.01, 5.0, 60.0, 85.0, 88.0, 89.0 })
    {
      const glm::dvec3 toLight = slantingBy(degrees, 36.87); // texels are not aligned with edges
      placeSun(sun, toLight);
      this->expectLit(scene, towardsSun(toLight), 10000, { 0.999, 0.9 },
        std::to_string(degrees) + " degrees, map " + std::to_string(mapSize));
    }
  }
}

/// A plane seen along itself from its near end, where views are strongly warped.
TEST_BY_VARIANTS(LitScenes, LongPlane, isForAll)
{
  PassScene scene(150, 150);
  scene.addFloor(100.0);
  vtkLight* const sun = scene.addSun({ 0.0, 0.0, -1.0 });
  this->chooseWithoutFloor(scene);
  scene.lookFrom({ 3.0, -98.0, 2.0 }, { 0.0, 0.0, 0.0 });
  // A warp makes the plane's depths a hyperbola, whose mean may lie before the receiver. For a
  // kernel a quarter as wide as the map, that costs 0.014 at most. The rectangle that keeps a
  // kernel of 3 texels even is 6 texels long there.
  const double mean = GetParam().hasSetting("kernel_size=16") ? 0.985
    : GetParam().hasSetting("blur=sat")                       ? 0.998
                                                              : 0.999;
  for (const int mapSize : GetParam().mapSizes({ 64, 256 }))
  {
    GetParam().set(scene.pass, "map_size", std::to_string(mapSize));
    for (const auto& [degrees, turn] :
      { std::pair(5.0, 10.0), { 5.0, 190.0 }, { 60.0, 80.0 }, { 60.0, 260.0 }, { 85.0, 10.0 },
        { 85.0, 80.0 }, { 85.0, 190.0 }, { 85.0, 260.0 }, { 89.0, 10.0 }, { 89.0, 260.0 } })
    {
      const glm::dvec3 toLight = slantingBy(degrees, turn);
      placeSun(sun, toLight);
      this->expectLit(scene, towardsSun(toLight), 5000, { mean, 0.0 },
        std::to_string(degrees) + " degrees, turned by " + std::to_string(turn) + ", map " +
          std::to_string(mapSize));
    }
  }
}

/// Receivers are rounded by parts of a texel, and the map's levels are coarse.
TEST_BY_VARIANTS(LitScenes, PlaneFromFarAway, isForAll)
{
  PassScene scene(150, 150);
  scene.addFloor(4.0);
  vtkLight* const sun = scene.addSun({ 0.0, 0.0, -1.0 });
  this->chooseWithoutFloor(scene);
  for (const double times : { 4.0, 16.0, 100.0 })
  {
    const bool isNarrow = times == 100.0;
    if (!isNarrow && !GetParam().isMoments())
    {
      continue; // coarse levels of the map
    }
    scene.lookFrom(times * glm::dvec3(1.0, -7.0, 6.0));
    scene.renderer->GetActiveCamera()->SetViewAngle(isNarrow ? 60.0 / times : 30.0);
    scene.renderer->ResetCameraClippingRange();
    for (const double degrees : { 0.0, 30.0, 85.0 })
    {
      const glm::dvec3 toLight = slantingBy(degrees, 36.87);
      placeSun(sun, toLight);
      this->expectLit(scene, towardsSun(toLight), isNarrow ? 5000 : 10, { 0.999, 0.0 },
        std::to_string(times) + " times as far, " + std::to_string(degrees) + " degrees");
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
    for (const int mapSize : GetParam().mapSizes({ 64, 1024 }))
    {
      GetParam().set(scene.pass, "map_size", std::to_string(mapSize));
      for (const double height : { cone == 50.0 ? 3.0 : 1.0, cone == 50.0 ? 0.3 : 0.1 })
      {
        // The visible rest of a lamp that the floor cuts loses a hundredth in single pixels.
        const bool isCut = GetParam().technique() == "montecarlo" &&
          GetParam().hasSetting("light_radius=0.5") && height < 0.5;
        const glm::dvec3 light(-3.0, -2.0, height);
        spot->SetPosition(light.x, light.y, light.z);
        // Half a degree inside the cone, so rounding does not decide.
        const double inside = std::cos(glm::radians(cone - 0.5));
        const ToLight toLight = [=](const glm::dvec3& point)
        {
          const bool isInCone =
            glm::dot(glm::normalize(point - light), glm::normalize(-light)) > inside;
          return isInCone ? light - point : glm::dvec3(0.0);
        };
        this->expectLit(scene, toLight, 5000, { 0.99, mapSize == 64 ? 0.6 : 0.7 },
          "cone " + std::to_string(cone) + ", height " + std::to_string(height) + ", map " +
            std::to_string(mapSize),
          0.0, isCut ? 0.99f : 1.0f);
      }
    }
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
    for (const int mapSize : GetParam().mapSizes({ 64, 1024 }))
    {
      GetParam().set(scene.pass, "map_size", std::to_string(mapSize));
      for (const double height : { tilt == 0.0 ? 8.0 : 1.0, 0.3, 0.07 })
      {
        const double along[3] = { 0.1, 0.2, height };
        const double* const point = turn->TransformDoublePoint(along);
        lamp->SetPosition(point);
        this->expectLit(scene, towardsLamp({ point[0], point[1], point[2] }), 5000, { 0.98, 0.6 },
          "height " + std::to_string(height) + ", map " + std::to_string(mapSize) + ", tilted by " +
            std::to_string(tilt));
      }
    }
  }
}

/// Convex: every surface that faces the light is lit. Within a texel of the terminator, the map
/// cannot tell.
TEST_BY_VARIANTS(LitScenes, ConvexSphere, hasPlainKernel)
{
  PassScene scene(300, 300);
  scene.addSphere(glm::dvec3(0.0), 1.0);
  scene.addSun({ 1.0, 0.4, -1.5 });
  this->choose(scene);
  scene.lookFrom({ -2.0, -2.0, 3.0 });
  for (const int mapSize : GetParam().mapSizes({ 64, 256, 1024 }))
  {
    GetParam().set(scene.pass, "map_size", std::to_string(mapSize));
    this->expectLit(scene, towardsSun({ -1.0, -0.4, 1.5 }), 20000, { 0.999, 0.9 },
      "map " + std::to_string(mapSize), 4.0 / mapSize + 0.05);
  }
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
    lamp->SetPosition(light.x, light.y, light.z);
    for (const int mapSize : GetParam().mapSizes({ 32, 256 }))
    {
      GetParam().set(scene.pass, "map_size", std::to_string(mapSize));
      const double corner = mapSize == 32 ? 1.9 : -1.9;
      scene.lookFrom({ corner, 0.95 * corner, corner });
      scene.renderer->GetActiveCamera()->SetViewAngle(100.0);
      scene.renderer->GetActiveCamera()->SetClippingRange(0.01, 10.0);
      this->expectLit(scene, towardsLamp(light), 39999, { 0.85, 0.0 },
        textOf(light) + ", map " + std::to_string(mapSize));
    }
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
  vtkLight* const sun = scene.addSun({ 0.0, 0.0, -1.0 });
  this->choose(scene);
  vtkCamera* const camera = scene.renderer->GetActiveCamera();
  for (const double distance : { 14.0, 1000.0, 10000.0 })
  {
    scene.lookFrom(distance * glm::normalize(glm::dvec3(8.0, 9.0, 7.0)));
    camera->SetViewAngle(distance > 14.0 ? 2.0 * glm::degrees(std::atan(4.0 / distance)) : 30.0);
    camera->SetClippingRange(std::max(distance - 20.0, 0.1), distance + 20.0);
    for (const int mapSize :
      GetParam().mapSizes({ distance == 10000.0 ? 1024 : 256, distance == 14.0 ? 64 : 1024 }))
    {
      GetParam().set(scene.pass, "map_size", std::to_string(mapSize));
      for (const glm::dvec3& toLight :
        { glm::dvec3(1.0, 0.8, 1.0), { 0.3, 1.0, 0.1 }, { 0.1, 0.1, 1.0 } })
      {
        placeSun(sun, toLight);
        this->expectLit(scene, towardsSun(toLight), 5000, {},
          textOf(toLight) + ", map " + std::to_string(mapSize) + ", from " +
            std::to_string(distance));
      }
    }
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
    vtkLight* const sun = scene.addSun({ 0.0, 0.0, -1.0 });
    scene.lookFrom({ 3.0, -98.0, 2.0 }, { 0.0, 0.0, 10.0 });
    for (const int mapSize : GetParam().mapSizes({ 64, 256 }))
    {
      GetParam().set(scene.pass, "map_size", std::to_string(mapSize));
      for (const glm::dvec3& toLight :
        { glm::dvec3(0.0, -0.3, 1.0), { 0.0, 1.0, 1.0 }, { -1.0, -0.3, 0.5 }, { 1.0, 0.2, 0.6 } })
      {
        placeSun(sun, toLight);
        this->expectLit(scene, towardsSun(toLight), 5000, {},
          "valley at " + std::to_string(valley) + ", map " + std::to_string(mapSize) + ", " +
            textOf(toLight));
      }
    }
  }
}
