#include "Study.h"

#include "ErrorFront.h"
#include "Errors.h"
#include "SyntheticResults.h"
#include "TestFiles.h"

#include <vtkNew.h>
#include <vtkXMLDataParser.h>

#include <gmock/gmock.h>

#include <sstream>

namespace gnomon::tool
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

/// A study of two small pictures.
StudyPlan smallPlan()
{
  StudyPlan plan;
  plan.scenes = { "cube" };
  plan.views = 2;
  plan.hardTechniques = { "nsm", "raytraced" };
  plan.softTechniques = { "raytraced" };
  plan.lightSamples = { 4, 8 };
  plan.comparison.mapSizesTexels = { 64 };
  plan.comparison.width = plan.comparison.height = 48;
  plan.comparison.frames = 1;
  plan.comparison.truthSamples = 16;
  return plan;
}

StudyRow row(const std::string& scene, const std::string& variant, double error, double overPlain)
{
  StudyRow made;
  made.of.scene = scene;
  made.variant = made.technique = variant;
  made.wrongShare = error;
  made.overPlain = { overPlain, 2.0 * overPlain, 3.0 * overPlain };
  return made;
}

/// @param steps gets how many steps the study told of
std::vector<StudyRow> run(const StudyPlan& plan, const TestFolder& folder, int& steps)
{
  steps = 0;
  return runStudy(plan, folder.path(), [&](double, const std::string&) { ++steps; });
}

std::vector<std::string> variantsOf(const std::vector<StudyRow>& rows)
{
  std::vector<std::string> names;
  for (const StudyRow& of : rows)
  {
    names.push_back(of.variant);
  }
  return names;
}

} // namespace

//------------------------------------------------------------------------------
TEST(ErrorFront, isWhatNoOtherOneBeats)
{
  EXPECT_THAT(paretoFront({}), ElementsAre());
  EXPECT_THAT(paretoFront({ { 0.5, 1.0 }, { 0.4, 3.0 }, { 0.1, 2.0 }, { 0.1, 2.5 }, { 0.0, 4.0 } }),
    ElementsAre(0, 2, 4));
  EXPECT_THAT(paretoFront({ { 0.1, 2.0 }, { 0.1, 2.0 } }), ElementsAre(0)) << "equal";
  EXPECT_THAT(paretoFront({ { 0.1, 2.0 }, { 0.099, 3.0 } }), ElementsAre(0)) << "hardly less";
}

//------------------------------------------------------------------------------
TEST(WorstPlace, isWhereTheDifferencesAre)
{
  std::vector<float> differences(60 * 40, 0.0f);
  EXPECT_FALSE(worstPlace(differences, 60, 40, 8).has_value());
  differences[10 * 60 + 50] = 0.5f;
  differences[30 * 60 + 20] = differences[31 * 60 + 21] = 0.4f;
  const Place worst = *worstPlace(differences, 60, 40, 8);
  EXPECT_TRUE(worst.left <= 20 && 21 < worst.left + 8) << worst.left;
  EXPECT_TRUE(worst.top <= 30 && 31 < worst.top + 8) << worst.top;
  EXPECT_EQ(worstPlace(differences, 60, 40, 100)->side, 40) << "no larger than the picture";
}

//------------------------------------------------------------------------------
TEST(WorstPlace, isShownEnlarged)
{
  Picture picture = greyPicture(6, 4);
  picture.rgb[3 * (2 * 6 + 3)] = 10;
  const Picture place = enlarged(picture, { 3, 1, 2 }, 3);
  EXPECT_EQ(place.width, 6);
  EXPECT_EQ(place.height, 6);
  for (int y = 0; y < 6; ++y)
  {
    for (int x = 0; x < 6; ++x)
    {
      const bool isDark = x < 3 && y >= 3;
      EXPECT_EQ(place.rgb[static_cast<std::size_t>(3 * (6 * y + x))], isDark ? 10 : 200);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Reduced, isTheMeanOfBlocks)
{
  Picture picture = greyPicture(7, 4);
  picture.rgb[0] = 100;
  const Picture small = reduced(picture, 4);
  EXPECT_EQ(small.width, 3);
  EXPECT_EQ(small.height, 2);
  EXPECT_EQ(small.rgb.size(), 18u);
  EXPECT_EQ(small.rgb[0], 175);
  EXPECT_EQ(small.rgb[1], 200);
  EXPECT_EQ(reduced(picture, 100).rgb, picture.rgb);
  EXPECT_EQ(reduced(greyPicture(9, 1), 3).rgb.size(), 9u);
}

//------------------------------------------------------------------------------
TEST(WorstPlace, isAmongThePixelsThatCount)
{
  const VisibilityImages truth = floorTruth();
  VisibilityImages flipped = truth;
  flipHundredPixels(flipped);
  flipped.visibility[0].back() = 0.0f; // background
  std::vector<float> differences;
  measureError(flipped, truth, { lightFromAbove() }, nullptr, &differences);
  EXPECT_EQ(std::count(differences.begin(), differences.end(), 1.0f), 100);
  EXPECT_EQ(std::count(differences.begin(), differences.end(), 0.0f), 40 * 30 - 100);
}

//------------------------------------------------------------------------------
TEST(Study, sumsUpWhatTookPartInAllCases)
{
  const std::vector<StudySummary> summaries = summarise(
    { row("a", "nsm", 0.01, 1.0), row("a", "pssm", 0.0, 2.0), row("b", "nsm", 0.03, 4.0) });
  ASSERT_EQ(summaries.size(), 1u);
  EXPECT_EQ(summaries[0].variant, "nsm");
  EXPECT_NEAR(summaries[0].error, 0.02, 1e-12);
  EXPECT_NEAR(summaries[0].overPlain[0], 2.0, 1e-12);
  EXPECT_NEAR(summaries[0].overPlain[2], 6.0, 1e-12);
}

//------------------------------------------------------------------------------
TEST(Study, goesOnWhereItWasInterrupted)
{
  const TestFolder folder;
  StudyPlan plan = smallPlan();
  int steps = 0;
  const std::vector<StudyRow> rows = run(plan, folder, steps);
  EXPECT_GT(steps, 0);
  EXPECT_THAT(variantsOf(rows),
    ElementsAre("plain VTK", "vtkShadowMapPass 64", "nsm 64", "raytraced", "plain VTK",
      "vtkShadowMapPass 64", "nsm 64", "raytraced"));
  EXPECT_NE(rows[2].wrongShare, rows[6].wrongShare) << "another view";
  EXPECT_EQ(rows[0].overPlain[0], 1.0);
  EXPECT_GT(rows[0].worst.pixelCount(), 0u);
  EXPECT_EQ(rows[3].worst.pixelCount(), 0u) << "the truth is right everywhere";

  const std::vector<StudyRow> again = run(plan, folder, steps);
  EXPECT_EQ(steps, 0) << "all cases are there";
  EXPECT_EQ(toCsv(again), toCsv(rows));
  EXPECT_EQ(again[0].worst.rgb, rows[0].worst.rgb);

  const std::string file = folder / "cube--view-2/rows.json";
  for (const char* damage : { "", "[1, 2]", "{\"how\": ", "{}", "null" })
  {
    std::ofstream(file) << damage;
    EXPECT_EQ(run(plan, folder, steps).size(), rows.size());
    EXPECT_GT(steps, 0) << damage;
  }
  std::filesystem::remove(file);
  run(plan, folder, steps);
  EXPECT_GT(steps, 0) << "a case is gone";
  std::filesystem::remove(folder / "cube--view-2/nsm-64.png");
  run(plan, folder, steps);
  EXPECT_GT(steps, 0) << "a picture is gone";
  plan.comparison.mapSizesTexels = { 32 };
  run(plan, folder, steps);
  EXPECT_GT(steps, 0) << "another plan";
}

//------------------------------------------------------------------------------
TEST(Study, takesAllSamplesOfSoftShadows)
{
  const TestFolder folder;
  StudyPlan plan = smallPlan();
  plan.scenes = { "soft-stack" };
  plan.views = 1;
  plan.lightSamples = { 4, 64 };
  int steps = 0;
  const std::vector<StudyRow> rows = run(plan, folder, steps);
  EXPECT_THAT(variantsOf(rows),
    ElementsAre("plain VTK", "vtkShadowMapPass 64", "raytraced light_samples=4", "raytraced"));
  EXPECT_TRUE(rows[0].of.soft);
  EXPECT_EQ(rows[0].error(), rows[0].rootMeanSquare);
  EXPECT_GT(rows[2].rootMeanSquare, rows[3].rootMeanSquare);
}

//------------------------------------------------------------------------------
TEST(Study, namesTheSceneThatItCannotRead)
{
  const TestFolder folder;
  StudyPlan plan = smallPlan();
  plan.scenes.push_back("no-such-scene");
  int steps = 0;
  try
  {
    run(plan, folder, steps);
    FAIL() << "no error";
  }
  catch (const BadInput& error)
  {
    EXPECT_THAT(error.what(), HasSubstr("no-such-scene"));
  }
  EXPECT_EQ(steps, 0) << "before any work is done";
}

//------------------------------------------------------------------------------
TEST(Study, neverAdvisesToDrawNoShadows)
{
  const std::vector<StudyRow> rows = { row("a", plainTechnique, 0.001, 1.0),
    row("a", "nsm", 0.0005, 1.5), row("a", "raytraced", 0.0, 2.0) };
  EXPECT_THAT(studyPage(rows, "a machine"),
    testing::AllOf(HasSubstr("<b>nsm</b> shows"), testing::Not(HasSubstr("<b>plain VTK</b>"))));
}

//------------------------------------------------------------------------------
TEST(Study, tellsOfSoftShadowsApart)
{
  std::vector<StudyRow> rows = { row("a", plainTechnique, 0.3, 1.0),
    row("a", "raytraced", 0.0, 2.0) };
  for (const char* variant : { "pcss", "penumbra" })
  {
    rows.push_back(row("b", variant, 0.0, variant == std::string("pcss") ? 2.0 : 5.0));
    rows.back().of.soft = true;
    rows.back().rootMeanSquare = variant == std::string("pcss") ? 0.02 : 0.003;
  }
  const std::string page = studyPage(rows, "a machine");
  EXPECT_THAT(page,
    HasSubstr("<b>penumbra</b> is the most accurate for soft shadows, with an RMS "
              "error of 0.00300"));
  EXPECT_THAT(page, HasSubstr("<b>pcss</b> shows an RMS error of 0.0200"));
  EXPECT_THAT(page, HasSubstr("all scenes with soft shadows"));
  rows[2].rootMeanSquare = 0.05; // more than is good enough, but there is nothing else
  EXPECT_THAT(studyPage(rows, "a machine"), HasSubstr("<b>pcss</b> shows an RMS error of 0.0500"));
}

//------------------------------------------------------------------------------
TEST(Study, hasAPageThatSaysWhatToUse)
{
  std::vector<StudyRow> rows = { row("a & <b>", "plain VTK", 0.1, 1.0),
    row("a & <b>", "nsm", 0.004, 1.5), row("a & <b>", "pcf", 0.004, 3.0),
    row("a & <b>", "raytraced", 0.0, 2.0) };
  rows[1].worst = greyPicture(20, 10);
  const std::string page = studyPage(rows, "a machine");
  EXPECT_THAT(page, HasSubstr("<b>raytraced</b> is the most accurate for hard shadows"));
  EXPECT_THAT(page, HasSubstr("<b>nsm</b> shows 0.400 % wrong pixels"));
  EXPECT_THAT(page, HasSubstr("data-of=\"a &amp; &lt;b&gt;/camera_moving\""));
  EXPECT_THAT(page, HasSubstr("nsm, a &amp; &lt;b&gt;, view 1: 0.400 % wrong pixels"));
  EXPECT_THAT(page, HasSubstr("a machine"));
  EXPECT_EQ(page.find("{{"), std::string::npos);
  std::istringstream text(page);
  vtkNew<vtkXMLDataParser> parser;
  parser->SetStream(&text);
  EXPECT_EQ(parser->Parse(), 1) << "well-formed XML";
}

} // namespace gnomon::tool
