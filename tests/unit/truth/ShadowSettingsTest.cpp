#include "lights/SettingsTable.h"

#include "lights/vtkGnomonLightKeys.h"
#include "shadowtech/Registry.h"

#include <gtest/gtest.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkObject.h>

#include <variant>

namespace gnomon::test
{
namespace
{

TEST(ShadowSettings, refuseWhatTheyDoNotTakeAndStayAsTheyAre)
{
  ShadowSettings settings;
  for (const char* text : { "", "15", "16385", "64.5", "64 ", " 64", "0x40", "99999999999", "nan" })
  {
    EXPECT_FALSE(findSetting("map_size")->set(settings, text)) << text;
    EXPECT_EQ(settings.mapSizeTexels, 1024);
  }
  EXPECT_EQ(findSetting("map_size")->expected(), "an integer in [16, 16384]");
  for (const char* text : { "", "Box", "box ", "1" })
  {
    EXPECT_FALSE(findSetting("kernel")->set(settings, text)) << text;
    EXPECT_EQ(settings.pcf.kernel, FilterKernel::Bilinear);
  }
  EXPECT_TRUE(findSetting("kernel")->set(settings, "poisson"));
  EXPECT_EQ(settings.pcf.kernel, FilterKernel::Poisson);
}

TEST(ShadowSettings, takeEveryChoiceAndGiveItBack)
{
  for (const gnomon::Setting* each : shadowSettings())
  {
    const gnomon::Setting& setting = *each;
    const auto* choice = std::get_if<ChoiceSetting>(&setting.values);
    for (std::size_t i = 0; choice && i < choice->names.size(); ++i)
    {
      ShadowSettings settings;
      EXPECT_TRUE(setting.set(settings, choice->names[i])) << setting.name;
      EXPECT_EQ(setting.get(settings), choice->names[i]) << setting.name;
    }
  }
  ShadowSettings settings;
  EXPECT_TRUE(findSetting("contour")->set(settings, "6"));
  EXPECT_EQ(settings.chain.contourPixels, 6);
  EXPECT_TRUE(findSetting("contour")->set(settings, "image"));
  EXPECT_EQ(settings.chain.contourPixels, 0);
  EXPECT_TRUE(findSetting("map_samples")->set(settings, "8"));
  EXPECT_EQ(settings.momentMap.samples, 8);
}

} // namespace
} // namespace gnomon::test
