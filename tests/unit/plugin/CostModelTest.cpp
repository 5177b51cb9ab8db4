#include "plugin/plan/CostModel.h"

#include "PassScene.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace gnomon;
using testing::HasSubstr;

namespace
{

struct CostFactorsFile : gnomon::test::PassTest
{
  /// Return why a text is no file of cost factors; empty if it is one.
  std::string refusal(const std::string& text)
  {
    std::ofstream(this->path_) << text;
    try
    {
      readFactors(this->path_);
      return "";
    }
    catch (const std::runtime_error& error)
    {
      return error.what();
    }
  }

  const std::string path_ =
    (std::filesystem::path(testing::TempDir()) / "gnomon_factors.txt").string();
};

} // namespace

TEST(CostModel, knowsSoftwareByItsName)
{
  for (const auto& [name, isSoftware] :
    { std::pair("llvmpipe (LLVM 15.0.6, 256 bits)", true), { "Google SwiftShader", true },
      { "GDI Generic", true }, { "NVIDIA GeForce RTX 4090/PCIe/SSE2", false },
      { "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", false },
      { "AMD Radeon RX 6800 (radeonsi, navi21, LLVM 15.0.6)", false } })
  {
    EXPECT_EQ(isSoftwareRenderer(name), isSoftware) << name;
  }
}

TEST_F(CostFactorsFile, isReadAsItWasWritten)
{
  CostFactors factors = defaultFactors(true);
  factors.bakeTexel = 0.125;
  EXPECT_EQ(this->refusal("# a comment\n" + textOf(factors)), "");
  const CostFactors read = readFactors(this->path_);
  for (const NamedFactor& factor : namedFactors())
  {
    EXPECT_EQ(read.*factor.member, factors.*factor.member) << factor.name;
  }
}

TEST_F(CostFactorsFile, isRefusedWithTheLine)
{
  const std::string good = textOf(defaultFactors(false));
  EXPECT_THAT(this->refusal(good + "draw_pixel 3\n"), HasSubstr("line 11: found draw_pixel again"));
  EXPECT_THAT(this->refusal("draw_pixel -1\n"), HasSubstr("line 1: found \"draw_pixel -1\""));
  EXPECT_THAT(this->refusal("draw_pixel nan\n"), HasSubstr("line 1"));
  EXPECT_THAT(this->refusal("draw_pixel 1 2\n"), HasSubstr("line 1"));
  EXPECT_THAT(this->refusal("\nmagic 1\n"), HasSubstr("line 2: found magic, which is no factor"));
  EXPECT_THAT(this->refusal("draw_pixel 1\n"), HasSubstr("draw_triangle is missing"));
  EXPECT_THROW(readFactors(this->path_ + ".none"), std::runtime_error);
}

TEST_F(CostFactorsFile, ofAPassThatIsNoneIsAnError)
{
  vtkNew<vtkGnomonShadowPass> pass;
  pass->ReadCostFactors("/nowhere");
  EXPECT_THAT(this->takeErrors(), HasSubstr("/nowhere cannot be read"));
  pass->ReadCostFactors(nullptr); // the default ones
}

/// Return the counters of the bunny under one light, at rest.
FrameCounters countersOfTheBunny()
{
  FrameCounters counters;
  counters.drawn = counters.triangles = 70000;
  counters.pixels = 1 << 20;
  counters.texels = 1 << 20;
  counters.lights = 1;
  counters.tracedLights = 1.0;
  return counters;
}

// Choices follow from the factors: if maps cost nothing, maps are chosen.
TEST(CostModel, costsGrowWithWhatThereIs)
{
  const CostFactors factors = defaultFactors(true);
  FrameCounters counters = countersOfTheBunny();
  const double atRest = costByRays(counters, factors);
  EXPECT_LT(atRest, costByMaps(counters, factors)) << "what is exact is fetched, maps are asked";
  counters.viewMoved = true;
  EXPECT_GT(costByRays(counters, factors), 1.3 * costByMaps(counters, factors));
  counters.viewMoved = false;
  counters.movedLights = 1;
  EXPECT_LT(costByRays(counters, factors), costByMaps(counters, factors)) << "a map is drawn anew";
  counters.movedLights = 0;
  counters.viewMoved = true;
  counters.triangles = 20000000; // the meshes of 70,000 solids
  counters.newMaps = 1;
  EXPECT_LT(costByRays(counters, factors), costByMaps(counters, factors))
    << "30 frames do not pay for such a map";
  counters.movedLights = 1;
  counters.castersMoved = true;
  counters.drawn = counters.triangles = 10000000;
  EXPECT_GT(costByMaps(counters, factors), 800.0) << "ms";
}

TEST(CostModel, onGpusMapsAreFastExceptAtRest)
{
  const CostFactors factors = defaultFactors(false);
  FrameCounters counters = countersOfTheBunny();
  EXPECT_LT(costByRays(counters, factors), 1.3 * costByMaps(counters, factors));
  counters.viewMoved = true;
  EXPECT_GT(costByRays(counters, factors), 4.0 * costByMaps(counters, factors));
  counters.viewMoved = false;
  counters.movedLights = 1;
  EXPECT_GT(costByRays(counters, factors), 4.0 * costByMaps(counters, factors));
}
