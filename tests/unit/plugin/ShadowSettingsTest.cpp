// vtkGnomonShadowSettings: typed settings of passes and lights.

#include "PassScene.h"

#include "lights/SettingsTable.h"
#include "vtkGnomonShadowSettings.h"

#include <set>
#include <sstream>

using namespace gnomon::test;
using testing::HasSubstr;

namespace
{

struct ShadowSettingsTest
  : PassTest
  , BoxScene
{
  ShadowSettingsTest()
    : BoxScene(64, 48)
  {
  }

  vtkNew<vtkGnomonShadowSettings> settings;
};

} // namespace

TEST_F(ShadowSettingsTest, gettersReadWhatSettersSet)
{
  this->settings->SetTechnique("pcf");
  this->settings->SetKernelToBox();
  this->settings->SetKernelSize(5);
  this->settings->SetLightRadius(0.5);
  this->settings->SnapOff();
  EXPECT_EQ(this->settings->GetTechnique(), "pcf");
  EXPECT_EQ(this->settings->GetKernel(), vtkGnomonShadowSettings::KERNEL_BOX);
  EXPECT_EQ(this->settings->GetKernelAsString(), "box");
  EXPECT_EQ(this->settings->GetKernelSize(), 5);
  EXPECT_EQ(this->settings->GetLightRadius(), 0.5);
  EXPECT_FALSE(this->settings->GetSnap());
  EXPECT_EQ(this->settings->GetSetting("kernel_size"), "5");
}

TEST_F(ShadowSettingsTest, numbersAreClampedToTheirRange)
{
  this->settings->SetMapSize(1);
  EXPECT_EQ(this->settings->GetMapSize(), 16);
  this->settings->SetMapSize(1000000);
  EXPECT_EQ(this->settings->GetMapSize(), 16384);
  this->pass->SetMapSize(1 << 20);
  this->pass->SetRoute(7);
  EXPECT_EQ(this->pass->GetRoute(), static_cast<int>(vtkGnomonShadowPass::ROUTE_DEFERRED));
  std::ostringstream text;
  this->pass->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("Setting map_size: 16384"));
  this->settings->SetSplitLambda(7.0);
  EXPECT_EQ(this->settings->GetSplitLambda(), 1.0);
  this->settings->SetLightRadius(std::numeric_limits<double>::infinity());
  EXPECT_EQ(this->settings->GetLightRadius(), std::numeric_limits<double>::max());
  this->settings->SetKernel(77);
  EXPECT_EQ(this->settings->GetKernelAsString(),
    std::get<gnomon::ChoiceSetting>(gnomon::findSetting("kernel")->values).names.back());
}

TEST_F(ShadowSettingsTest, mistakesAreErrorsAndChangeNothing)
{
  const vtkMTimeType before = this->settings->GetMTime();
  this->settings->SetSplitLambda(std::nan(""));
  EXPECT_THAT(this->takeErrors(), HasSubstr("split_lambda"));
  this->settings->SetTechnique("magic");
  EXPECT_THAT(this->takeErrors(), HasSubstr("expected one of: auto, nsm"));
  this->settings->SetSetting("kernel_sise", "3");
  EXPECT_THAT(this->takeErrors(), HasSubstr("no setting 'kernel_sise'"));
  this->settings->SetSetting(nullptr, nullptr);
  EXPECT_THAT(this->takeErrors(), HasSubstr("no setting ''"));
  EXPECT_EQ(this->settings->GetMTime(), before);
}

TEST_F(ShadowSettingsTest, theListHasAllOfThem)
{
  std::set<std::string> names;
  for (int i = 0; i < vtkGnomonShadowSettings::GetNumberOfSettings(); ++i)
  {
    names.insert(vtkGnomonShadowSettings::GetSettingName(i));
    EXPECT_NE(vtkGnomonShadowSettings::GetSettingMeaning(i), "");
    EXPECT_NE(vtkGnomonShadowSettings::GetSettingValues(i), "");
  }
  EXPECT_EQ(names.size(), gnomon::shadowSettings().size());
  EXPECT_EQ(names.count("kernel_size"), 1u);
  EXPECT_EQ(vtkGnomonShadowSettings::GetSettingName(-1), "");
  EXPECT_EQ(vtkGnomonShadowSettings::GetSettingUnit(1000), "");
}

TEST_F(ShadowSettingsTest, passesShareThem)
{
  vtkNew<vtkGnomonShadowPass> other;
  this->settings->SetTechnique("pcf");
  this->pass->SetSettings(this->settings);
  other->SetSettings(this->settings);
  EXPECT_STREQ(other->GetTechnique(), "pcf");
  this->render();
  EXPECT_EQ(this->report().lights[0].technique, "pcf");
  this->settings->SetTechnique("raytraced");
  this->render();
  EXPECT_EQ(this->report().lights[0].technique, "raytraced");
  this->pass->SetSetting("technique", "vsm");
  EXPECT_EQ(this->settings->GetTechnique(), "vsm");
  this->pass->SetSettings(nullptr);
  EXPECT_STREQ(this->pass->GetTechnique(), "auto");
  EXPECT_STREQ(other->GetTechnique(), "vsm");
}

// A setting by name overrides one by object, and that overrides the pass's. Settings that an object
// leaves unset are the pass's.
TEST_F(ShadowSettingsTest, lightsHaveTheirOwn)
{
  this->pass->SetTechnique("nsm");
  this->pass->SetMapSize(256);
  this->settings->SetTechnique("pcf");
  this->settings->SetKernelSize(7);
  vtkGnomonLightKeys::SetSettings(this->sun, this->settings);
  EXPECT_EQ(vtkGnomonLightKeys::GetSettings(this->sun), this->settings.GetPointer());
  this->render();
  EXPECT_EQ(this->report().lights[0].technique, "pcf");
  EXPECT_EQ(this->report().lights[0].mapSizeTexels, 256);
  EXPECT_EQ(this->report().lights[0].kernelTexels, 7);
  vtkGnomonLightKeys::SetSetting(this->sun, "kernel_size", "3");
  this->render();
  EXPECT_EQ(this->report().lights[0].kernelTexels, 3);
  vtkGnomonLightKeys::SetSetting(this->sun, "kernel_size", nullptr);
  this->settings->UnsetSetting("kernel_size");
  EXPECT_FALSE(this->settings->IsSettingSet("kernel_size"));
  EXPECT_TRUE(this->settings->IsSettingSet("technique"));
  this->pass->SetSetting("kernel_size", "9");
  this->render();
  EXPECT_EQ(this->report().lights[0].kernelTexels, 9);
  this->pass->GetSettings()->UnsetSetting("kernel_size");
  vtkGnomonLightKeys::SetSettings(this->sun, nullptr);
  this->render();
  EXPECT_EQ(this->report().lights[0].technique, "nsm");
}
