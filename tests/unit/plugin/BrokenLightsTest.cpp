// Lights with invalid numbers. Each is left out with a reason that names the fault, or gives
// visibilities in [0, 1].

#include "PassScene.h"

#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

using Break = std::function<void(vtkLight* light)>;

/// Limit a light to a box of these numbers.
Break box(const std::vector<double>& numbers)
{
  return [=](vtkLight* light)
  {
    light->GetInformation()->Set(
      vtkGnomonLightKeys::BOX(), numbers.data(), static_cast<int>(numbers.size()));
  };
}

/// Make a light a lamp above the floor.
Break lamp(const glm::dvec3& place, double coneAngleDegrees = allDirections)
{
  return [=](vtkLight* light)
  {
    light->PositionalOn();
    light->SetConeAngle(coneAngleDegrees);
    light->SetPosition(place.x, place.y, place.z);
  };
}
const glm::dvec3 above(0.0, 0.0, 5.0);

struct BrokenLight
{
  const char* name;
  Break breakIt;
  const char* reason; ///< empty if the light casts
};

const BrokenLight brokenLights[] = {
  { "lampAtNoPlace", lamp({ nan, 0.0, 5.0 }), "its position is not finite" },
  { "lampAtInfinity", lamp({ 0.0, 0.0, infinity }), "its position is not finite" },
  { "lampFarBeyondFloats", lamp({ 0.0, 0.0, 1e300 }), "" },
  { "spotFarBeyondFloats", lamp({ 0.0, 0.0, 2e18 }, 30.0), "" },
  { "spotFarBeyondFloatsThatLooksAway",
    [](vtkLight* l)
    {
      lamp({ 0.0, 0.0, 2e18 }, 30.0)(l);
      l->SetFocalPoint(0.0, 0.0, 4e18);
    },
    "it is far away, and its cone passes the scene by" },
  { "boxFarBeyondFloats",
    [](vtkLight* l)
    {
      box({ 1.0, 1.0, 9.0, 0.0, 1.0, 0.0 })(l);
      l->SetPosition(0.0, 0.0, 2e18);
    },
    "its box begins too far away" },
  { "lampVeryFar", lamp({ 0.0, 0.0, 1e15 }), "" },
  { "lampInTheFloor", lamp({ 0.0, 0.0, 0.0 }), "" },
  { "lampWithoutCone", lamp(above, 0.0), "its cone is empty" },
  { "lampWithNoNumberAsCone", lamp(above, nan), "its cone is empty" },
  { "lampWithEndlessCone", lamp(above, infinity), "" },
  { "spotWithTheThinnestCone", lamp(above, 1e-300), "" },
  { "spotThatLooksNowhere",
    [](vtkLight* l) { lamp(above, 30.0)(l), l->SetFocalPoint(nan, 0.0, 0.0); },
    "its position and focal point give no direction" },
  { "sunFromNowhere", [](vtkLight* l) { l->SetFocalPoint(l->GetPosition()); },
    "its position and focal point give no direction" },
  { "sunFromBeyondAll", [](vtkLight* l) { l->SetPosition(0.0, 0.0, 1e200); },
    "its position and focal point give no direction" },
  { "strengthThatIsNoNumber",
    [](vtkLight* l) { l->SetShadowAttenuation(std::numeric_limits<float>::quiet_NaN()); },
    "its shadow attenuation is not a number" },
  { "negativeStrength", [](vtkLight* l) { l->SetShadowAttenuation(-1.0f); },
    "its shadow attenuation is 0" },
  { "endlessStrength",
    [](vtkLight* l) { l->SetShadowAttenuation(std::numeric_limits<float>::infinity()); }, "" },
  { "boxWithoutWidth", box({ 0.0, 1.0, 9.0, 0.0, 1.0, 0.0 }), "its box is empty" },
  { "boxOfNegativeHeight", box({ 1.0, -1.0, 9.0, 0.0, 1.0, 0.0 }), "its box is empty" },
  { "boxOfEndlessDepth", box({ 1.0, 1.0, infinity, 0.0, 1.0, 0.0 }), "its box is not finite" },
  { "boxOfNoNumber", box({ nan, 1.0, 9.0, 0.0, 1.0, 0.0 }), "its box is not finite" },
  { "boxWithoutUp", box({ 1.0, 1.0, 9.0, 0.0, 0.0, 0.0 }),
    "its box has its up direction along the light" },
  { "boxWithUpAlongTheLight", box({ 1.0, 1.0, 9.0, 0.3, 0.2, -1.0 }),
    "its box has its up direction along the light" },
  { "boxWithNoNumberUp", box({ 1.0, 1.0, 9.0, 0.0, nan, 0.0 }), "its box is not finite" },
  { "boxOfFiveNumbers", box({ 1.0, 1.0, 9.0, 0.0, 1.0 }), "its box has 5 numbers instead of 6" },
  { "smallestBox", box({ 1e-300, 1e-300, 1e-300, 0.0, 1.0, 0.0 }), "" },
  { "largestBox", box({ 1e300, 1e300, 1e300, 0.0, 1.0, 0.0 }), "" },
  { "boxOfALamp",
    [](vtkLight* l)
    {
      lamp(above)(l);
      box({ nan, -1.0, 0.0, 0.0, 0.0, 0.0 })(l); // lamps have no box
    },
    "" },
  { "largestRadius", [](vtkLight* l) { lamp(above)(l), set(l, "light_radius", "1e300"); },
    "its area is too large" },
  { "largestRadiusBeyondFloats",
    [](vtkLight* l)
    {
      lamp({ 0.0, 0.0, 1e20 })(l);
      set(l, "light_radius", "1e19");
    },
    "" },
};

using BrokenLights = PassTestOf<Way>;

INSTANTIATE_TEST_SUITE_P(Ways, BrokenLights, allWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnPlanes, BrokenLights, testing::Values(planarWay), nameOf);
INSTANTIATE_TEST_SUITE_P(ThroughLayers, BrokenLights, testing::Values(layersWay), nameOf);

} // namespace

TEST_P(BrokenLights, areLeftOutWithAReasonOrGiveVisibilities)
{
  for (const BrokenLight& broken : brokenLights)
  {
    SCOPED_TRACE(broken.name);
    PassScene scene(60, 40);
    scene.addSphereOverFloor();
    scene.choose(GetParam());
    vtkLight* light = scene.addSun({ 0.3, 0.2, -1.0 });
    broken.breakIt(light);

    const VisibilityImages& kept = drawKept(scene); // checks the numbers
    ASSERT_EQ(scene.report().lights.size(), 1u);
    EXPECT_EQ(scene.report().lights[0].reason, broken.reason);
    const bool casts = std::string(broken.reason).empty();
    EXPECT_EQ(kept.visibility.size(), casts ? 1u : 0u);
    scene.pass->KeepVisibilityOff();
    const Picture picture = scene.render();
    EXPECT_TRUE(casts || picture == scene.renderPlain());
  }
}
