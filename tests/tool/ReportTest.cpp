#include "Report.h"

#include "Commands.h"
#include "Errors.h"
#include "SyntheticResults.h"
#include "TestFiles.h"

#include <vtkNew.h>
#include <vtkXMLDataParser.h>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <sstream>

namespace gnomon::tool
{
namespace
{

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

using Json = nlohmann::ordered_json;

bool isWellFormed(const std::string& page)
{
  std::istringstream text(page);
  vtkNew<vtkXMLDataParser> parser;
  parser->SetStream(&text);
  return parser->Parse() == 1;
}

std::vector<std::string> variantsOf(const Rows& rows)
{
  std::vector<std::string> names;
  for (const Row& of : rows)
  {
    names.push_back(of.at("variant"));
  }
  return names;
}

TEST(Report, CsvHasTheNumbers)
{
  ComparisonResults results = syntheticResults();
  EXPECT_EQ(csvOf(results.json),
    "variant,technique,route,map_size,facing_pixels,wrong_pixels,wrong_share,false_light_pixels,"
    "false_shadow_pixels,mean_absolute_error,rms_error,between_pixels,between_share,traced_pixels,"
    "static_ms,static_stage_share,camera_moving_ms,camera_moving_maps_ms,camera_moving_shading_ms,"
    "camera_moving_stage_share,light_moving_ms,light_moving_stage_share,occluder_bytes,bvh_bytes,"
    "map_bytes,image_bytes,resident_growth_bytes,class traced_pixels,class no receiver_pixels\r\n"
    "plain VTK,plain "
    "VTK,,,1000,500,0.5,300,200,0.5,0.5,7,0.007,0,30,,30,,,,30,,1048576,0,0,0,-5,,\r\n"
    "nsm 1024 inline,nsm,inline,1024,1000,100,0.1,60,40,0.1,0.5,7,0.007,0,36,,36,8.25,26.5,0.965,"
    "36,,1048576,0,0,0,-5,,\r\n"
    "raytraced,raytraced,,,1000,0,0,0,0,0,0.5,7,0.007,1000,60,,60,,,,60,,1048576,0,0,0,-5,1000,24"
    "\r\n");
  results.json["frames"] = 0;
  EXPECT_THAT(csvOf(results.json), AllOf(Not(HasSubstr("_ms")), Not(HasSubstr("stage"))));
  EXPECT_EQ(csvLine({ "", "a, \"b\"", "c\nd", 1, 1.0 / 3.0, Json() }),
    ",\"a, \"\"b\"\"\",\"c\nd\",1,0.333333333,\r\n");
}

/// The choice and its worst places come before all that folds out.
TEST(Report, PageBeginsWithTheConclusion)
{
  ComparisonResults results = syntheticResults();
  results.pictures[1].picture.rgb.assign(3 * 40 * 30, 50);
  const auto place = [&](std::size_t variant) {
    return dataUri(cropped(results.pictures[variant].picture, { 0, 0, 8 }));
  };
  const std::string page = pageOf(results);
  const std::string first = page.substr(0, page.find("<details>"));
  EXPECT_THAT(std::regex_replace(first, std::regex("\\s+"), " "),
    AllOf(HasSubstr("<h1>Shadows compared: floor &amp; &lt;half&gt; &quot;shadow&quot;</h1>"),
      HasSubstr("<b>raytraced</b> is the most accurate for hard shadows, with 0 % wrong pixels. It "
                "takes 2.00 times plain VTK's"),
      HasSubstr("<b>nsm 1024 inline</b> shows 10.0 % wrong pixels in 1.20 times"),
      HasSubstr("<tr><td>raytraced</td> <td>0 %</td> <td>2.00</td><td>2.00</td>"),
      HasSubstr(place(2) + "\" /><small>truth<"), HasSubstr(place(1) + "\" /><small>technique<"),
      HasSubstr("<figcaption>nsm 1024 inline, floor &amp; &lt;half&gt; &quot;shadow&quot;: 10.0 % "
                "wrong pixels</figcaption>"),
      HasSubstr("nsm 1024 inline: A limit, of &quot;some&quot; kind."), HasSubstr("<svg "),
      Not(HasSubstr("<b>plain VTK</b>")), Not(HasSubstr("casting lights"))));
  EXPECT_EQ(first.find("<figcaption>"), first.rfind("<figcaption>")) << "each place once";
  EXPECT_THAT(page,
    AllOf(HasSubstr("10.0 %<small>100</small>"), HasSubstr("36.0 ms<small>1.20 x"),
      HasSubstr("1.0 MB"), HasSubstr("<td>9.1</td>"), Not(HasSubstr("{{"))));
}

TEST(Report, PageIsWellFormedAndNeedsNoOtherFile)
{
  const std::string page = pageOf(syntheticResults());
  EXPECT_TRUE(isWellFormed(page));
  for (const char* loaded : { "url(", "@import", "<script", "<link", "href=" })
  {
    EXPECT_THAT(page, Not(HasSubstr(loaded)));
  }
  const std::regex source("src=\"(.{0,22})");
  int images = 0;
  for (std::sregex_iterator match(page.begin(), page.end(), source), end; match != end; ++match)
  {
    EXPECT_EQ((*match)[1], "data:image/png;base64,");
    ++images;
  }
  EXPECT_EQ(images, 2 + 2 * 3 + 1) << "a place, each variant's pictures, and one of classes";
}

TEST(Report, WithoutTimedFramesNothingHasATime)
{
  ComparisonResults results = syntheticResults();
  results.json["frames"] = 0;
  for (Json& variant : results.json["variants"])
  {
    variant.erase("times");
  }
  const TestFolder folder;
  writeReport(results, folder / "report");
  const std::string page = readBytes(folder / "report/report.html");
  EXPECT_TRUE(isWellFormed(page));
  EXPECT_THAT(page,
    AllOf(HasSubstr("No frames were timed."), HasSubstr("nsm 1024 inline, floor"),
      Not(HasSubstr(" ms<")), Not(HasSubstr("<svg")), Not(HasSubstr("most accurate"))));
  EXPECT_FALSE(std::filesystem::exists(folder / "report/chart.svg"));
}

TEST(Report, WritesEveryFile)
{
  const TestFolder folder;
  const std::string target = folder / "new/report";
  writeReport(syntheticResults(), target);
  for (const char* name : { "results.csv", "report.html", "plain VTK.png", "nsm.png",
         "nsm-errors.png", "raytraced-classes.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(target) / name)) << name;
  }
  EXPECT_EQ(Json::parse(readBytes(target + "/results.json")), syntheticResults().json);
  EXPECT_TRUE(isWellFormed(readBytes(target + "/chart.svg")));
  EXPECT_EQ(readPicture(target + "/nsm.png").rgb, greyPicture(40, 30).rgb);

  writeBytes(folder / "file", "text");
  EXPECT_THROW(prepareReportFolder(folder / "file"), BadInput);
  EXPECT_THROW(prepareReportFolder(folder / "file/below"), BadInput);
}

TEST(Rows, FrontIsWhatNoOtherOneBeats)
{
  const auto front = [](const Rows& rows)
  { return variantsOf(frontOf(rows, "static_over_plain")); };
  EXPECT_THAT(front({}), ElementsAre());
  EXPECT_THAT(front({ row("s", "a", 0.5, 1.0), row("s", "b", 0.4, 3.0), row("s", "c", 0.1, 2.0),
                row("s", "d", 0.1, 2.5), row("s", "e", 0.0, 4.0) }),
    ElementsAre("a", "c", "e"));
  EXPECT_THAT(front({ row("s", "a", 0.1, 2.0), row("s", "b", 0.1, 2.0) }), ElementsAre("a"));
  EXPECT_THAT(front({ row("s", "a", 0.1, 2.0), row("s", "b", 0.099, 3.0) }), ElementsAre("a"));
}

TEST(Rows, MeansAreOfVariantsThatTookPartInAllCases)
{
  Rows rows = { row("a", "nsm", 0.01, 1.0), row("a", "pcf", 0.5, 1.0), row("b", "nsm", 0.03, 4.0) };
  rows[2]["place"] = { { "of", "b" } };
  const Rows means = meansOf(rows);
  ASSERT_THAT(variantsOf(means), ElementsAre("nsm"));
  EXPECT_NEAR(errorOf(means[0]), 0.02, 1e-12);
  EXPECT_NEAR(means[0].at("static_over_plain").get<double>(), 2.0, 1e-12);
  EXPECT_NEAR(means[0].at("light_moving_over_plain").get<double>(), 6.0, 1e-12);
  EXPECT_EQ(means[0].at("place").at("of"), "b") << "the worst case's";
}

TEST(Chart, HoldsEveryPointAndLabelsTheFront)
{
  // Errors from 0 to much, times alike, of which the front's labels would overlap.
  Rows rows = { row("s", "plain VTK", 0.3, 1.0), row("s", "beaten", 0.3, 1.5),
    row("s", "raytraced", 0.0, 1.02) };
  for (int i = 0; i < 8; ++i)
  {
    rows.push_back(row("s", "variant " + std::to_string(i), 0.01 - 0.0005 * i, 1.001 + 0.001 * i));
  }
  for (const Rows& shown : { rows, Rows{ rows[2] }, Rows{ rows[1] } })
  {
    const Json chart = chartOf(shown, Motion::Camera);
    EXPECT_EQ(chart.at("points").size(), shown.size());
    EXPECT_GE(chart.at("xTicks").size(), 2u);
    for (const Json& point : chart.at("points"))
    {
      EXPECT_TRUE(
        point.at("x") >= 80 && point.at("x") <= 620 && point.at("y") >= 15 && point.at("y") <= 460)
        << point;
    }
    double above = 0.0;
    for (const Json& point : chart.at("front"))
    {
      const double y = point.at("labelY");
      EXPECT_GE(y, above + 15.9) << point;
      above = y;
    }
  }
  const Json chart = chartOf(rows, Motion::Camera);
  EXPECT_EQ(chart.at("front").size(), 10u);
  EXPECT_EQ(chart.at("yTicks")[0].at("label"), "0");
  EXPECT_THAT(chart.at("yTicks").dump(), AllOf(HasSubstr("\"1 %\""), HasSubstr("\"10 %\"")));
}

TEST(Pictures, OfPlacesAreWhereTheDifferencesAre)
{
  std::vector<float> differences(60 * 40, 0.0f);
  EXPECT_FALSE(worstPlace(differences, 60, 40, 8).has_value());
  differences[10 * 60 + 50] = 0.5f;
  differences[30 * 60 + 20] = differences[31 * 60 + 21] = 0.4f;
  const Place worst = *worstPlace(differences, 60, 40, 8);
  EXPECT_TRUE(worst.left <= 20 && 21 < worst.left + 8) << worst.left;
  EXPECT_TRUE(worst.top <= 30 && 31 < worst.top + 8) << worst.top;
  EXPECT_EQ(worstPlace(differences, 60, 40, 100)->side, 40) << "no larger than the picture";

  Picture picture = greyPicture(7, 4);
  picture.rgb[0] = 100;
  EXPECT_EQ(cropped(picture, { 0, 0, 2 }).rgb,
    (std::vector<unsigned char>{ 100, 200, 200, 200, 200, 200, 200, 200, 200, 200, 200, 200 }));
  const Picture small = reduced(picture, 4);
  EXPECT_EQ(small.width, 3);
  EXPECT_EQ(small.rgb.size(), 18u);
  EXPECT_EQ(small.rgb[0], 175);
  EXPECT_EQ(reduced(picture, 100).rgb, picture.rgb);
  EXPECT_EQ(reduced(greyPicture(9, 1), 3).rgb.size(), 9u);
}

TEST(Pictures, StandSideBySideBelowTheirTitles)
{
  Picture dark = greyPicture(120, 50);
  dark.rgb[0] = 7;
  const Picture joined = sideBySide({ { "one", dark }, { "", greyPicture(120, 50) } });
  ASSERT_EQ(joined.width, 2 * 120 + panelGapColumns);
  ASSERT_EQ(joined.height, panelTitleRows + 50);
  const auto byte = [&](int x, int y) { return joined.rgb[3 * (y * joined.width + x)]; };
  EXPECT_EQ(byte(0, panelTitleRows), 7);
  EXPECT_EQ(byte(120, panelTitleRows), 255) << "the gap";
  EXPECT_EQ(byte(120 + panelGapColumns, panelTitleRows), 200);
  int darkest[2] = { 255, 255 }; // of each title
  for (int i = 0; i < 120 * panelTitleRows; ++i)
  {
    darkest[0] = std::min<int>(darkest[0], byte(i % 120, i / 120));
    darkest[1] = std::min<int>(darkest[1], byte(120 + panelGapColumns + i % 120, i / 120));
  }
  EXPECT_LT(darkest[0], 100);
  EXPECT_EQ(darkest[1], 255);
}

/// Run `gnomon study` with small pictures, and return its table.
std::string studied(const TestFolder& folder, const std::string& options)
{
  CLI::App app("gnomon");
  addStudyCommand(app);
  app.parse(
    "study --techniques nsm,raytraced --samples 4,64 --map-sizes 64 --size 48x48 --frames 1 "
    "--truth-samples 16 -o " +
    folder.path() + " " + options);
  return readBytes(folder / "study.csv");
}

/// Times of two runs differ, so equal tables are from one run.
TEST(Study, GoesOnWhereItWasInterrupted)
{
  const TestFolder folder;
  const std::string options = "--scenes cube --views 2";
  const std::string table = studied(folder, options);
  EXPECT_EQ(studied(folder, options), table);
  const auto rowsOfView = [](const std::string& of, const char* view)
  {
    std::string rows;
    std::istringstream lines(of);
    for (std::string line; std::getline(lines, line);)
    {
      rows += line.rfind(std::string("cube,hard,") + view, 0) == 0 ? line : "";
    }
    return rows;
  };
  for (const char* damage : { "", "{\"how\": ", "null" })
  {
    std::ofstream(folder / "cube--view-2/rows.json") << damage;
    const std::string repaired = studied(folder, options);
    EXPECT_EQ(rowsOfView(repaired, "1"), rowsOfView(table, "1")) << damage;
    EXPECT_NE(rowsOfView(repaired, "2"), rowsOfView(table, "2")) << damage;
    EXPECT_EQ(std::count(repaired.begin(), repaired.end(), '\n'), 9) << damage;
  }
  EXPECT_THAT(studied(folder, options + " --map-sizes 32"), HasSubstr("nsm 32,")) << "another plan";
  EXPECT_THAT(messageOf<BadInput>([&] { studied(folder, "--scenes cube,no-such-scene"); }),
    HasSubstr("no-such-scene"));
}

TEST(Study, HasATableAndAPageOfHardAndSoftShadows)
{
  const TestFolder folder;
  EXPECT_THAT(studied(folder, "--scenes cube,soft-stack --views 1"),
    AllOf(HasSubstr("scene,shadows,view,variant,technique,wrong_share,rms_error,"
                    "mean_absolute_error,static_ms,static_over_plain,camera_moving_ms,"
                    "camera_moving_over_plain,light_moving_ms,light_moving_over_plain\r\n"
                    "cube,hard,1,plain VTK,plain VTK,"),
      HasSubstr("\r\ncube,hard,1,nsm 64,nsm,"),
      HasSubstr("\r\nsoft-stack,soft,1,raytraced light_samples=4,raytraced,")));
  const std::string page = readBytes(folder / "study.html");
  EXPECT_TRUE(isWellFormed(page));
  EXPECT_THAT(std::regex_replace(page, std::regex("\\s+"), " "),
    AllOf(HasSubstr("<b>raytraced</b> is the most accurate for hard shadows, with 0 % wrong"),
      HasSubstr("most accurate for soft shadows, with an RMS error of 0.0"),
      HasSubstr("2 cases, measured on: "),
      HasSubstr("data-of=\"all scenes with soft shadows/camera_moving\""),
      HasSubstr("data-of=\"cube/static\""), HasSubstr("<option value=\"soft-stack\">"),
      HasSubstr("nsm 64, cube, view 1: "), Not(HasSubstr("{{"))));
}

} // namespace
} // namespace gnomon::tool
