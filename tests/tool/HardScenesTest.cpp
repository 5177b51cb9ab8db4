// The scenes of numerical hard cases: every case has one or says where it is held, and all
// techniques draw them with finite numbers.

#include "HardScenes.h"

#include "FrameVariant.h"
#include "VtkMessages.h"

#include "shadowtech/Registry.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace gnomon::tool
{
namespace
{

/// The hard cases of the literature: apelles N1 to N29, crsm N1 to N15, and so on.
std::set<std::string> allCases()
{
  std::set<std::string> cases;
  const auto add = [&](const std::string& begin, int count)
  {
    for (int i = 1; i <= count; ++i)
    {
      cases.insert(begin + std::to_string(i));
    }
  };
  add("apelles N", 29);
  add("crsm N", 15);
  add("selective 5.1.", 7);
  add("selective 5.2.", 12);
  add("montecarlo 5.", 16);
  add("survey ", 18);
  for (const char part : std::string("abcdefgh"))
  {
    cases.insert(std::string("survey 7.12") + part);
  }
  return cases;
}

class HardScenes : public testing::TestWithParam<HardScene>
{
};

INSTANTIATE_TEST_SUITE_P(All, HardScenes, testing::ValuesIn(hardScenes()),
  [](const testing::TestParamInfo<HardScene>& of)
  {
    std::string name = of.param.scene.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

} // namespace

//------------------------------------------------------------------------------
TEST(HardCases, allHaveASceneOrSayWhereTheyAreHeld)
{
  std::set<std::string> named;
  for (const HardScene& scene : hardScenes())
  {
    EXPECT_EQ(scene.scene.name.rfind("hard-", 0), 0u) << scene.scene.name;
    EXPECT_EQ(findBuiltinScene(scene.scene.name), &scene.scene);
    named.insert(scene.cases.begin(), scene.cases.end());
  }
  for (const HardCaseElsewhere& elsewhere : hardCasesElsewhere())
  {
    EXPECT_TRUE(named.insert(elsewhere.hardCase).second) << elsewhere.hardCase << " has a scene";
  }
  EXPECT_EQ(named, allCases());
}

//------------------------------------------------------------------------------
TEST_P(HardScenes, areDrawnWithFiniteNumbers)
{
  const Scene scene = withoutShadowSettings(GetParam().scene.make());
  const VtkMessages messages;
  for (const char* technique : { "nsm", "vsm", "pcss", "silhouette", "penumbra" })
  {
    VariantSpec spec = parseTechnique(technique);
    spec.mapSizeTexels = estimatorOf(settingsOf(spec)).info.bakesMap() ? 64 : 0;
    spec.route = vtkGnomonShadowPass::ROUTE_IMAGE;
    FrameVariant variant(spec, scene, 64, 48);
    variant.pass()->KeepVisibilityOn();
    variant.drawFrame(Motion::Static, 0);
    const VisibilityImages& images = variant.pass()->GetVisibility();
    ASSERT_FALSE(images.visibility.empty()) << technique;
    std::size_t counted = 0;
    for (const std::vector<float>& image : images.visibility)
    {
      for (std::size_t i = 0; i < image.size(); ++i)
      {
        ASSERT_TRUE(image[i] >= 0.0f && image[i] <= 1.0f) << technique << ", " << image[i];
        counted += images.coverage[i] != 0.0f ? 1 : 0;
      }
    }
    EXPECT_GT(counted, 100u) << technique << ": something is seen";
  }
  EXPECT_THAT(messages.errors(), testing::IsEmpty());
}

} // namespace gnomon::tool
