// SetMemoryBudget decides which lights have maps.

#include "PassScene.h"

#include "plugin/plan/MemoryBudget.h"

using namespace gnomon;
using namespace gnomon::test;
using testing::HasSubstr;
using testing::Not;
using LightWay = LightShare::Way;

namespace
{

constexpr double mebibyte = 1024.0 * 1024.0;

/// Return a light whose map of 1024 texels a side takes 4 MiB; shaders may call its technique.
LightNeed lamp(double mostLight)
{
  LightNeed need;
  need.mostLight = mostLight;
  need.mapSizeTexels = 1024;
  need.bytesPerTexel = 4.0;
  need.isPointwise = true;
  return need;
}

/// Share a budget among lights of a picture of a megapixel, whose image of numbers takes 4 MiB.
/// Return each light's map's side; 0 for rays, -1 for no shadow.
std::vector<int> sidesOf(const std::vector<LightNeed>& lights, double mebibytes, bool isInline)
{
  std::vector<int> sides;
  for (const LightShare& share :
    shareMemory(lights, mebibytes * mebibyte, 1024 * 1024, isInline).lights)
  {
    sides.push_back(share.way == LightWay::Map ? share.mapSizeTexels
        : share.way == LightWay::Rays          ? 0
                                               : -1);
  }
  return sides;
}

const std::vector<LightNeed> lamps = { lamp(1.0), lamp(3.0), lamp(2.0) };
using Sides = std::vector<int>;

} // namespace

TEST(MemoryBudget, brightLightsKeepTheirMaps)
{
  EXPECT_EQ(sidesOf(lamps, 12.0, true), (Sides{ 1024, 1024, 1024 }));
  EXPECT_EQ(sidesOf(lamps, 9.5, true), (Sides{ 512, 1024, 1024 }));
  EXPECT_EQ(sidesOf(lamps, 5.25, true), (Sides{ 256, 1024, 512 }));
}

// Images come first, since they also show the shadows of rays. Maps share the rest.
TEST(MemoryBudget, thenTheyTakeRaysAndThenNone)
{
  EXPECT_EQ(sidesOf(lamps, 24.5, false), (Sides{ 256, 1024, 256 }));
  EXPECT_EQ(sidesOf(lamps, 24.0, false), (Sides{ 0, 1024, 0 }));
  EXPECT_EQ(sidesOf(lamps, 19.9, false), (Sides{ -1, 512, 512 }));
  EXPECT_EQ(sidesOf(lamps, 7.0, false), (Sides{ -1, -1, -1 }));
}

TEST(MemoryBudget, mapsWhoseSizeNobodyKnowsGiveWayToRays)
{
  LightNeed unknown = lamp(1.0);
  unknown.isPointwise = false;
  unknown.isHard = true;
  unknown.bytesPerTexel = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sidesOf({ unknown }, 1e6, true), Sides{ 0 });
  unknown.bytesPerTexel = 0.0; // it has no map
  EXPECT_EQ(sidesOf({ unknown }, 8.0, true), Sides{ 1024 });
}

// 64 hard lights share an image of bits. Other lights, and techniques with their own images, take
// one each.
TEST(MemoryBudget, imagesAreCountedWhereThereAreAny)
{
  const auto noneAmong = [](std::size_t lights, const LightNeed& need, double mebibytes)
  {
    const Sides sides = sidesOf(std::vector(lights, need), mebibytes, true);
    return std::count(sides.begin(), sides.end(), -1);
  };
  LightNeed rays;
  rays.isHard = true;
  EXPECT_EQ(noneAmong(64, rays, 8.0), 0);
  EXPECT_EQ(noneAmong(70, rays, 16.0), 4);
  LightNeed soft;
  soft.channels = 3;
  soft.bytesPerPixel = 8.0;
  EXPECT_EQ(noneAmong(2, soft, 48.0), 0);
  EXPECT_EQ(noneAmong(2, soft, 47.0), 1);
}

TEST(MemoryBudget, lampsGiveMostAtTheNearestPoint)
{
  Bounds seen;
  seen.add(glm::dvec3(-1.0));
  seen.add(glm::dvec3(1.0));
  ShadowLight light;
  light.kind = LightKind::Point;
  light.intensity = 6.0;
  light.positionWorld = { 4.0, 0.0, 0.0 };
  light.attenuation = { 1.0, 0.5, 0.0 };
  const TechniqueInfo& info = findTechnique("nsm")->estimator->info;
  EXPECT_DOUBLE_EQ(needOf(light, info, seen).mostLight, 6.0 / 2.5);
  light.positionWorld = { 0.5, 0.0, 0.0 };
  EXPECT_DOUBLE_EQ(needOf(light, info, seen).mostLight, 6.0);
  light.attenuation = { 0.0, 0.0, 1.0 };
  EXPECT_EQ(needOf(light, info, seen).mostLight, std::numeric_limits<double>::infinity());
}

namespace
{

/// A box over a floor under a lamp all around.
struct MemoryBudgetOfPass
  : PassTest
  , PassScene
{
  MemoryBudgetOfPass()
    : PassScene(128, 96)
  {
    this->addFloor(20.0);
    this->addBox(hangingBox.lower, hangingBox.upper);
    this->lookFrom({ 4.0, -9.0, 7.0 });
  }

  vtkLight* addLamp(double x, double intensity)
  {
    vtkLight* const light = this->addSpot({ x, 0.0, 6.0 }, { x, 0.0, 0.0 }, allDirections);
    light->SetIntensity(intensity);
    return light;
  }
  void turn()
  {
    this->renderer->GetActiveCamera()->Azimuth(1.0);
    this->render();
  }
  std::string budgetReason(std::size_t light) const
  {
    return this->report().lights[light].budgetReason;
  }
};

} // namespace

// The bytes of a map are known before baking, for all techniques that state them.
TEST_F(MemoryBudgetOfPass, mapsTakeAtMostWhatIsExpected)
{
  this->addLamp(0.0, 1.0);
  constexpr int side = 512;
  this->pass->SetMapSize(side);
  this->pass->SetSetting("light_radius", "0.5"); // for techniques with soft shadows
  for (const TechniqueEntry& entry : registry())
  {
    const TechniqueInfo& info = entry.estimator->info;
    if (!info.bytesPerTexel || entry.projection != Projection::Uniform) // a lamp has faces
    {
      continue;
    }
    SCOPED_TRACE(entry.name);
    this->pass->SetTechnique(entry.name.c_str());
    this->render();
    ASSERT_TRUE(this->report().lights[0].casts) << this->report().lights[0].reason;
    ShadowLight light;
    light.kind = LightKind::Point;
    light.mapSizeTexels = side;
    light.projection = entry.projection;
    const double expected = info.bytesPerTexel(light) * side * side;
    const double images = info.bytesPerPixel * 128 * 96;
    const double tables = 0.5 * mebibyte;
    const auto bytes = static_cast<double>(this->report().bytesMaps);
    EXPECT_LE(bytes, expected + images + tables);
    EXPECT_GE(bytes, 0.1 * expected) << "a bound that loose says nothing";
  }
}

TEST_F(MemoryBudgetOfPass, theReportSaysWhatIsLeft)
{
  this->addLamp(-2.0, 0.2);
  this->addLamp(0.0, 1.0);
  this->addLamp(2.0, 0.5);
  this->pass->SetTechnique("nsm"); // six faces of 4 MiB a lamp
  const Picture asked = this->render();
  EXPECT_EQ(this->report().lights[0].mapSizeTexels, 1024);
  this->pass->SetMemoryBudget(72.0);
  EXPECT_TRUE(asked == this->render());
  EXPECT_EQ(budgetReason(0), "");

  this->pass->SetMemoryBudget(32.0);
  this->render();
  EXPECT_LE(this->report().bytesMaps, 32 * 1024 * 1024u);
  EXPECT_EQ(this->report().lights[1].mapSizeTexels, 1024);
  EXPECT_EQ(budgetReason(1), "");
  EXPECT_EQ(this->report().lights[2].mapSizeTexels, 512);
  EXPECT_THAT(budgetReason(2), HasSubstr("coarser map"));

  this->pass->SetMemoryBudget(1.0);
  this->render();
  EXPECT_EQ(this->report().bytesMaps, 0u);
  EXPECT_EQ(this->report().lights[0].technique, "raytraced");
  EXPECT_THAT(budgetReason(0), HasSubstr("rays"));

  this->pass->SetMemoryBudget(0.05);
  this->render();
  EXPECT_FALSE(this->report().lights[0].casts);
  EXPECT_THAT(this->report().lights[0].reason, HasSubstr("memory budget"));
  EXPECT_EQ(this->report().route, "none");

  this->pass->SetMemoryBudget(0.0);
  EXPECT_TRUE(asked == this->render());
  this->pass->SetMemoryBudget(-1.0);
  EXPECT_THAT(this->takeErrors(), HasSubstr("MemoryBudget was to be"));
  EXPECT_EQ(this->pass->GetMemoryBudget(), 0.0);
}

TEST_F(MemoryBudgetOfPass, theReportCountsTheEdgesBetweenAnAreaAndItsReceivers)
{
  this->addLamp(0.0, 1.0);
  this->pass->SetTechnique("penumbra");
  this->pass->SetSetting("light_radius", "0.5");
  this->render();
  EXPECT_GT(this->report().bytesMaps, 0u);
}

// Memory of lights with named techniques is not available to `auto`.
TEST_F(MemoryBudgetOfPass, automaticLightsTakeWhatOthersLeave)
{
  vtkLight* const lamp = this->addLamp(0.0, 1.0);
  vtkGnomonLightKeys::SetSetting(lamp, "technique", "nsm");
  this->addSun(slantingSun)->SetIntensity(0.1);
  this->pass->SetTechnique("auto");
  this->pass->SetMemoryBudget(26.0); // the lamp's six faces may take 24
  this->pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
  for (int i = 0; i < 3; ++i)
  {
    this->turn();
    EXPECT_LE(this->report().bytesMaps, 26 * 1024 * 1024u);
  }
}

// `auto` is exact at rest with any budget. In motion it uses maps only if they fit the budget.
TEST_F(MemoryBudgetOfPass, automaticLightsKeepToIt)
{
  this->addSun(slantingSun);
  this->pass->SetTechnique("auto");
  const Picture expected = this->render();
  this->pass->SetMemoryBudget(6.0);
  EXPECT_TRUE(expected == this->render());
  EXPECT_EQ(this->report().lights[0].technique, "raytraced");
  EXPECT_EQ(budgetReason(0), "");
  this->pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
  this->turn();
  EXPECT_EQ(this->report().lights[0].technique, "nsm") << this->report().choice;
  EXPECT_LE(this->report().bytesMaps, 6 * 1024 * 1024u);
  this->pass->SetMemoryBudget(3.0);
  this->turn();
  EXPECT_EQ(this->report().bytesMaps, 0u);
  EXPECT_EQ(this->report().lights[0].technique, "raytraced");
  EXPECT_THAT(this->report().choice, HasSubstr("memory budget"));
}
