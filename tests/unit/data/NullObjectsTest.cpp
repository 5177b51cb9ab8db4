#include "VtkMessages.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "lights/vtkGnomonLightPlacement.h"
#include "lights/vtkGnomonSun.h"
#include "plugin/vtkGnomonFlatteringLights.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "plugin/vtkGnomonVisibilityFilter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

// The list of test_classes.py, without the calls that only Python's wrappers make, and without
// those of EGLRenderWindowTest.
TEST(NullObjects, areOneErrorOfEachMethod)
{
  using Keys = vtkGnomonLightKeys;
  using Props = vtkGnomonPropKeys;
  using Placement = vtkGnomonLightPlacement;
  vtkNew<vtkLight> light;
  vtkNew<vtkCamera> camera;
  vtkNew<vtkGnomonAreaLight> area;
  vtkNew<vtkGnomonShadowPass> pass;
  vtkNew<vtkGnomonSun> sun;
  vtkNew<vtkGnomonVisibilityFilter> filter;
  vtkNew<vtkGnomonFlatteringLights> flattering;
  vtkNew<vtkRenderer> renderer;
  const std::array<double, 6> box{ 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  std::array<double, 3> out{ 7.0, 7.0, 7.0 };
  const std::vector<std::pair<std::string, std::function<void()>>> calls{
    { "a light", [] { Keys::SetSetting(nullptr, "kernel", "box"); } },
    { "a light", [] { EXPECT_EQ(Keys::GetSetting(nullptr, "kernel"), nullptr); } },
    { "a light", [] { Keys::SetSettings(nullptr, nullptr); } },
    { "a light", [] { EXPECT_EQ(Keys::GetSettings(nullptr), nullptr); } },
    { "a light", [] { Keys::SetCasts(nullptr, false); } },
    { "a light", [] { EXPECT_TRUE(Keys::GetCasts(nullptr)); } },
    { "a light", [] { Keys::SetTechnique(nullptr, "nsm"); } },
    { "a light", [] { EXPECT_EQ(Keys::GetTechnique(nullptr), nullptr); } },
    { "a light", [] { Keys::SetMapSize(nullptr, 64); } },
    { "a light", [] { EXPECT_EQ(Keys::GetMapSize(nullptr), 0); } },
    { "a light", [&] { Keys::SetBox(nullptr, 1.0, 1.0, 1.0, box.data() + 1); } },
    { "a light", [&] { EXPECT_FALSE(Keys::GetBox(nullptr, out.data(), out.data())); } },
    { "a light", [] { Keys::RemoveBox(nullptr); } },
    { "a prop", [] { Props::SetCasts(nullptr, false); } },
    { "a prop", [] { Props::SetReceives(nullptr, false); } },
    { "a prop", [] { Props::SetOneSided(nullptr, true); } },
    { "a prop", [] { EXPECT_TRUE(Props::GetCasts(nullptr)); } },
    { "a prop", [] { EXPECT_TRUE(Props::GetReceives(nullptr)); } },
    { "a prop", [] { EXPECT_FALSE(Props::GetOneSided(nullptr)); } },
    { "a light", [&] { Placement::ShineOnSphere(nullptr, box.data(), 1.0); } },
    { "a light", [&] { Placement::ShineOnBox(nullptr, box.data()); } },
    { "cannot be placed", [&] { Placement::ShineOnPoints(light, nullptr); } },
    { "a camera", [&] { Placement::MakeKeyLight(nullptr, camera, box.data()); } },
    { "a camera", [&] { Placement::MakeKeyLight(light, nullptr, box.data()); } },
    { "a renderer and two", [&] { EXPECT_FALSE(flattering->Make(nullptr, light, light)); } },
    { "a renderer and two", [&] { EXPECT_FALSE(flattering->Make(renderer, nullptr, light)); } },
    { "a renderer and two", [&] { EXPECT_FALSE(flattering->Make(renderer, light, nullptr)); } },
    { "a light", [] { Placement::SetPitchAndYaw(nullptr, 10.0, 20.0); } },
    { "a light",
      []
      {
        std::array<double, 2> no;
        Placement::GetPitchAndYaw(nullptr, no.data());
      } },
    { "no light", [&] { area->DeepCopy(nullptr); } },
    { "a table", [&] { pass->GetReportTable(nullptr); } },
    { "an image", [&] { pass->GetVisibilityImage(nullptr); } },
    { "an array", [&] { EXPECT_FALSE(sun->MakeDayPath(60.0, nullptr, nullptr)); } },
    { "an array", [&] { EXPECT_FALSE(sun->MakeYearPath(1, 60.0, nullptr, nullptr)); } },
    { "an array", [&] { filter->AddDirections(nullptr); } },
    { "no sun", [&] { filter->AddSunDay(nullptr, 60.0); } },
    { "no sun", [&] { filter->AddSunYear(nullptr, 1, 60.0); } },
    { "null", [&] { filter->AddLight(nullptr); } },
  };
  const vtkMTimeType lightTime = light->GetMTime();
  const vtkMTimeType areaTime = area->GetMTime();
  for (std::size_t i = 0; i < calls.size(); ++i)
  {
    SCOPED_TRACE(i);
    const tool::VtkMessages messages;
    calls[i].second();
    EXPECT_THAT(messages.errors(), testing::ElementsAre(testing::HasSubstr(calls[i].first)));
  }
  EXPECT_EQ(light->GetMTime(), lightTime);
  EXPECT_EQ(area->GetMTime(), areaTime);
  EXPECT_EQ(filter->GetNumberOfLights(), 0);
  EXPECT_THAT(out, testing::Each(7.0));
}

} // namespace
} // namespace gnomon::test
