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

void setBox(vtkLight* light, const std::vector<double>& numbers)
{
  light->GetInformation()->Set(
    vtkGnomonLightKeys::BOX(), numbers.data(), static_cast<int>(numbers.size()));
}

/// A point light above the floor.
void makeLamp(vtkLight* light)
{
  light->PositionalOn();
  light->SetConeAngle(allDirections);
  light->SetPosition(0.0, 0.0, 5.0);
}

struct BrokenLight
{
  const char* name;
  void (*breakIt)(vtkLight* light);
  const char* reason; ///< empty if the light casts
};

const BrokenLight brokenLights[] = {
  { "lampAtNoPlace", [](vtkLight* l) { makeLamp(l), l->SetPosition(nan, 0.0, 5.0); },
    "its position is not finite" },
  { "lampAtInfinity", [](vtkLight* l) { makeLamp(l), l->SetPosition(0.0, 0.0, infinity); },
    "its position is not finite" },
  { "lampFarBeyondFloats", [](vtkLight* l) { makeLamp(l), l->SetPosition(0.0, 0.0, 1e300); }, "" },
  { "spotFarBeyondFloats",
    [](vtkLight* l) { makeLamp(l), l->SetPosition(0.0, 0.0, 2e18), l->SetConeAngle(30.0); }, "" },
  { "spotFarBeyondFloatsThatLooksAway",
    [](vtkLight* l)
    {
      makeLamp(l), l->SetPosition(0.0, 0.0, 2e18), l->SetConeAngle(30.0);
      l->SetFocalPoint(0.0, 0.0, 4e18);
    },
    "it is far away, and its cone passes the scene by" },
  { "boxFarBeyondFloats",
    [](vtkLight* l)
    {
      setBox(l, { 1.0, 1.0, 9.0, 0.0, 1.0, 0.0 });
      l->SetPosition(0.0, 0.0, 2e18);
    },
    "its box begins too far away" },
  { "lampVeryFar", [](vtkLight* l) { makeLamp(l), l->SetPosition(0.0, 0.0, 1e15); }, "" },
  { "lampInTheFloor", [](vtkLight* l) { makeLamp(l), l->SetPosition(0.0, 0.0, 0.0); }, "" },
  { "lampWithoutCone", [](vtkLight* l) { makeLamp(l), l->SetConeAngle(0.0); },
    "its cone is empty" },
  { "lampWithNoNumberAsCone", [](vtkLight* l) { makeLamp(l), l->SetConeAngle(nan); },
    "its cone is empty" },
  { "lampWithEndlessCone", [](vtkLight* l) { makeLamp(l), l->SetConeAngle(infinity); }, "" },
  { "spotWithTheThinnestCone", [](vtkLight* l) { makeLamp(l), l->SetConeAngle(1e-300); }, "" },
  { "spotThatLooksNowhere",
    [](vtkLight* l) { makeLamp(l), l->SetConeAngle(30.0), l->SetFocalPoint(nan, 0.0, 0.0); },
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
  { "boxWithoutWidth",
    [](vtkLight* l) {
      setBox(l, { 0.0, 1.0, 9.0, 0.0, 1.0, 0.0 });
    },
    "its box is empty" },
  { "boxOfNegativeHeight",
    [](vtkLight* l) {
      setBox(l, { 1.0, -1.0, 9.0, 0.0, 1.0, 0.0 });
    },
    "its box is empty" },
  { "boxOfEndlessDepth",
    [](vtkLight* l) {
      setBox(l, { 1.0, 1.0, infinity, 0.0, 1.0, 0.0 });
    },
    "its box is not finite" },
  { "boxOfNoNumber",
    [](vtkLight* l) {
      setBox(l, { nan, 1.0, 9.0, 0.0, 1.0, 0.0 });
    },
    "its box is not finite" },
  { "boxWithoutUp",
    [](vtkLight* l) {
      setBox(l, { 1.0, 1.0, 9.0, 0.0, 0.0, 0.0 });
    },
    "its box has its up direction along the light" },
  { "boxWithUpAlongTheLight",
    [](vtkLight* l) {
      setBox(l, { 1.0, 1.0, 9.0, 0.3, 0.2, -1.0 });
    },
    "its box has its up direction along the light" },
  { "boxWithNoNumberUp",
    [](vtkLight* l) {
      setBox(l, { 1.0, 1.0, 9.0, 0.0, nan, 0.0 });
    },
    "its box is not finite" },
  { "boxOfFiveNumbers",
    [](vtkLight* l) {
      setBox(l, { 1.0, 1.0, 9.0, 0.0, 1.0 });
    },
    "its box has 5 numbers instead of 6" },
  { "smallestBox",
    [](vtkLight* l) {
      setBox(l, { 1e-300, 1e-300, 1e-300, 0.0, 1.0, 0.0 });
    },
    "" },
  { "largestBox",
    [](vtkLight* l) {
      setBox(l, { 1e300, 1e300, 1e300, 0.0, 1.0, 0.0 });
    },
    "" },
  { "boxOfALamp",
    [](vtkLight* l)
    {
      makeLamp(l);
      setBox(l, { nan, -1.0, 0.0, 0.0, 0.0, 0.0 }); // lamps have no box
    },
    "" },
  { "largestRadius", [](vtkLight* l) { makeLamp(l), set(l, "light_radius", "1e300"); },
    "its area is too large" },
  { "largestRadiusBeyondFloats",
    [](vtkLight* l)
    {
      makeLamp(l), l->SetPosition(0.0, 0.0, 1e20);
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
