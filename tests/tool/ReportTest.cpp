#include "Report.h"

#include "Errors.h"
#include "ReportChart.h"
#include "SyntheticResults.h"
#include "TestFiles.h"

#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <regex>
#include <sstream>

namespace gnomon::tool
{
namespace
{

/// One line of a CSV file as its cells.
std::vector<std::string> cells(const std::string& line)
{
  std::vector<std::string> result(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    if (line[i] == '"')
    {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"')
      {
        result.back() += '"';
        ++i;
      }
      else
      {
        quoted = !quoted;
      }
    }
    else if (line[i] == ',' && !quoted)
    {
      result.emplace_back();
    }
    else
    {
      result.back() += line[i];
    }
  }
  return result;
}

std::vector<std::vector<std::string>> table(const std::string& csv)
{
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(csv);
  for (std::string line; std::getline(text, line);)
  {
    EXPECT_EQ(line.back(), '\r');
    line.pop_back();
    rows.push_back(cells(line));
  }
  return rows;
}

std::size_t column(const std::vector<std::vector<std::string>>& rows, const std::string& name)
{
  const auto found = std::find(rows[0].begin(), rows[0].end(), name);
  EXPECT_NE(found, rows[0].end()) << name;
  return static_cast<std::size_t>(found - rows[0].begin());
}

TEST(Report, CsvSaysAHundredWrongPixels)
{
  const auto rows = table(toCsv(syntheticResults()));
  ASSERT_EQ(rows.size(), 4u);
  for (const std::vector<std::string>& row : rows)
  {
    EXPECT_EQ(row.size(), rows[0].size());
  }
  EXPECT_EQ(rows[2][column(rows, "variant")], "nsm 1024 inline");
  EXPECT_EQ(rows[2][column(rows, "wrong_pixels")], "100");
  EXPECT_EQ(rows[2][column(rows, "wrong_share")], "0.1");
  EXPECT_EQ(rows[2][column(rows, "false_light_pixels")], "60");
  EXPECT_EQ(rows[2][column(rows, "false_shadow_pixels")], "40");
  EXPECT_EQ(rows[2][column(rows, "map_size")], "1024");
  EXPECT_EQ(rows[2][column(rows, "camera_moving_maps_ms")], "8.25");
  EXPECT_EQ(rows[3][column(rows, "wrong_pixels")], "0");
  EXPECT_EQ(rows[3][column(rows, "map_size")], "");
  EXPECT_EQ(rows[3][column(rows, "camera_moving_maps_ms")], "");
  EXPECT_EQ(rows[3][column(rows, "traced_pixels")], "1000");
  EXPECT_EQ(rows[3][column(rows, "light_moving_ms")], "180");
  EXPECT_EQ(rows[3][column(rows, "class no receiver_pixels")], "24");
  EXPECT_EQ(rows[2][column(rows, "class no receiver_pixels")], "");
}

TEST(Report, CsvQuotesWhatNeedsIt)
{
  ComparisonResults results = syntheticResults();
  results.variants[1].name = "a, \"b\"";
  const auto rows = table(toCsv(results));
  EXPECT_EQ(rows[2][0], "a, \"b\"");
  EXPECT_EQ(rows[2].size(), rows[0].size());
}

TEST(Report, JsonSaysAHundredWrongPixels)
{
  const nlohmann::json json = nlohmann::json::parse(toJson(syntheticResults()));
  EXPECT_EQ(json.at("scene"), "floor & <half> shadow");
  EXPECT_EQ(json.at("triangles"), 12345);
  EXPECT_EQ(json.at("settings").at("VTK"), "9.1");
  const nlohmann::json& nsm = json.at("variants").at(1);
  EXPECT_EQ(nsm.at("name"), "nsm 1024 inline");
  EXPECT_EQ(nsm.at("error").at("wrong_pixels"), 100);
  EXPECT_EQ(nsm.at("error").at("false_light_pixels"), 60);
  EXPECT_EQ(nsm.at("error").at("false_shadow_pixels"), 40);
  EXPECT_EQ(nsm.at("error").at("facing_pixels"), 1000);
  EXPECT_EQ(nsm.at("times").at("light_moving").at("frame_ms"), 108.0);
  EXPECT_EQ(nsm.at("times").at("static").at("stages_ms").at("maps"), 8.25);
  EXPECT_EQ(json.at("variants").at(2).at("error").at("wrong_pixels"), 0);
  EXPECT_EQ(json.at("variants").at(2).at("class_pixels").at("no receiver"), 24);
  EXPECT_EQ(json.at("variants").at(2).at("class_picture"), "raytraced-classes.png");
  EXPECT_FALSE(nsm.contains("class_picture"));
}

/// The report with a small stand-in for the chart.
std::string syntheticHtml()
{
  return toHtml(syntheticResults(), greyPicture(4, 4));
}

TEST(Report, HtmlSaysAHundredWrongPixels)
{
  const std::string html = syntheticHtml();
  EXPECT_NE(html.find("<tr><td>nsm 1024 inline</td><td>10.0 %<small>100</small></td>"
                      "<td>6.00 %<small>60</small></td><td>4.00 %<small>40</small></td>"),
    std::string::npos);
  EXPECT_NE(html.find("<tr><td>raytraced</td><td>0 %<small>0</small></td>"), std::string::npos);
  EXPECT_NE(html.find("floor &amp; &lt;half&gt; shadow"), std::string::npos);
  EXPECT_NE(html.find("36.0 ms<small>1.20 x plain</small>"), std::string::npos);
  EXPECT_NE(html.find("A limit, of &quot;some&quot; kind."), std::string::npos);
  EXPECT_NE(html.find("traced 83.3 %, no receiver 2.00 %"), std::string::npos);
  EXPECT_NE(html.find("maps 8.25, shading 26.50"), std::string::npos);
  EXPECT_EQ(html.find("{{"), std::string::npos);
}

TEST(Report, HtmlNeedsNoOtherFileAndNoNetwork)
{
  const std::string html = syntheticHtml();
  EXPECT_EQ(html.find("http"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<link"), std::string::npos);
  EXPECT_EQ(html.find("href="), std::string::npos);
  const std::regex source("src=\"([^\"]{0,22})");
  int images = 0;
  for (std::sregex_iterator match(html.begin(), html.end(), source), end; match != end; ++match)
  {
    EXPECT_EQ((*match)[1], "data:image/png;base64,");
    ++images;
  }
  EXPECT_EQ(images, 8); // the chart, two pictures for each of three variants, and one of classes
}

/// The choices, and their worst places, come before all that folds out.
TEST(Report, HtmlBeginsWithTheConclusion)
{
  ComparisonResults results = syntheticResults();
  results.variants[1].worst = Place{ 0, 0, 8 };
  const std::string html = toHtml(results, greyPicture(4, 4));
  const std::string first = html.substr(0, html.find("<details>"));
  EXPECT_NE(
    first.find("<b>raytraced</b> is the most accurate for hard shadows"), std::string::npos);
  EXPECT_NE(first.find("<td>raytraced</td><td>0 %</td><td>2.00</td>"), std::string::npos);
  EXPECT_NE(first.find("<figcaption>nsm 1024 inline, floor &amp; &lt;half&gt; shadow: 10.0 % wrong "
                       "pixels</figcaption>"),
    std::string::npos);
  EXPECT_EQ(first.find("<figcaption>"), first.rfind("<figcaption>")) << "each place once";
  EXPECT_EQ(first.find("Settings"), std::string::npos);
}

TEST(Report, HtmlShowsReducedPictures)
{
  ComparisonResults results = syntheticResults();
  for (VariantResult& variant : results.variants)
  {
    variant.picture = variant.errors = greyPicture(1200, 900);
    for (std::size_t i = 0; i < variant.picture.rgb.size(); ++i)
    {
      variant.picture.rgb[i] = static_cast<unsigned char>(i * i % 251);
    }
  }
  EXPECT_LT(toHtml(results, greyPicture(4, 4)).size(), std::size_t(2 << 20));
}

TEST(Report, HtmlIsWellFormed)
{
  std::istringstream html(syntheticHtml());
  vtkNew<vtkXMLDataParser> parser;
  parser->SetStream(&html);
  ASSERT_EQ(parser->Parse(), 1);
  EXPECT_STREQ(parser->GetRootElement()->GetName(), "html");
}

TEST(Report, HtmlHoldsThePicturesThemselves)
{
  // The base64 of a known PNG begins with that of its signature and ends with that of its end mark.
  const std::string html = syntheticHtml();
  EXPECT_NE(html.find("base64,iVBORw0KGgo"), std::string::npos);
  EXPECT_NE(html.find("ErkJggg==\""), std::string::npos);
}

TEST(Report, WritesEveryFile)
{
  const TestFolder folder;
  const std::string target = folder / "new/report";
  writeReport(syntheticResults(), target);
  for (const char* name :
    { "results.csv", "results.json", "report.html", "chart.png", "plain-VTK.png",
      "plain-VTK-errors.png", "nsm-1024-inline.png", "nsm-1024-inline-errors.png", "raytraced.png",
      "raytraced-errors.png", "raytraced-classes.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(target) / name)) << name;
  }
  const Picture errors = readPicture(target + "/nsm-1024-inline-errors.png");
  int red = 0;
  int blue = 0;
  for (std::size_t i = 0; i < errors.pixelCount(); ++i)
  {
    red += errors.rgb[3 * i] == 255;
    blue += errors.rgb[3 * i + 2] == 255;
  }
  EXPECT_EQ(blue, 60);
  EXPECT_EQ(red, 40);
}

TEST(Report, WithoutTimedFramesNothingSaysATime)
{
  ComparisonResults results = syntheticResults();
  results.frames = 0;
  for (VariantResult& variant : results.variants)
  {
    variant.timings = {};
  }
  const auto rows = table(toCsv(results));
  EXPECT_EQ(rows[2][column(rows, "wrong_pixels")], "100");
  EXPECT_EQ(rows[2].size(), rows[0].size());
  for (const std::string& name : rows[0])
  {
    EXPECT_EQ(name.find("_ms"), std::string::npos) << name;
    EXPECT_EQ(name.find("stage"), std::string::npos) << name;
  }
  const nlohmann::json json = nlohmann::json::parse(toJson(results));
  EXPECT_EQ(json.at("frames"), 0);
  EXPECT_FALSE(json.at("variants").at(1).contains("times"));

  const TestFolder folder;
  const std::string target = folder / "report";
  writeReport(results, target);
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(target) / "chart.png"));
  const std::string html = toHtml(results, {});
  EXPECT_NE(html.find("No frames were timed."), std::string::npos);
  EXPECT_EQ(html.find("Frame, static"), std::string::npos);
  EXPECT_EQ(html.find("0.0 ms"), std::string::npos);
  EXPECT_EQ(html.find("alt=\"Chart"), std::string::npos);
  std::istringstream text(html);
  vtkNew<vtkXMLDataParser> parser;
  parser->SetStream(&text);
  EXPECT_EQ(parser->Parse(), 1);
}

TEST(Report, AFolderThatCannotBeMadeIsBadInput)
{
  const TestFolder folder;
  writeBytes(folder / "file", "text");
  EXPECT_THROW(prepareReportFolder(folder / "file"), BadInput);
  EXPECT_THROW(prepareReportFolder(folder / "file/below"), BadInput);
}

TEST(ReportChart, ScaleHoldsItsValuesAndZero)
{
  const LogScale scale({ 0.0, 0.034, 1.7, 28.0 }, " %");
  EXPECT_DOUBLE_EQ(scale.position(1.0), 0.0);
  EXPECT_DOUBLE_EQ(scale.position(10.0), 1.0);
  EXPECT_LT(scale.position(0.0), scale.position(0.034));
  EXPECT_LT(scale.lower(), scale.position(0.0));
  EXPECT_GT(scale.upper(), scale.position(28.0));
  EXPECT_EQ(scale.ticks().front().label, "0");
  EXPECT_EQ(scale.ticks()[1].label, "0.1 %");
  EXPECT_EQ(scale.ticks().back().label, "10 %");
}

TEST(ReportChart, ScaleOfEqualOrNoValuesIsStillAnAxis)
{
  for (const std::vector<double>& values :
    { std::vector<double>{ 10.0, 10.0 }, std::vector<double>{ 0.0 }, std::vector<double>{} })
  {
    const LogScale scale(values, "");
    EXPECT_GT(scale.upper(), scale.lower());
    EXPECT_GE(scale.ticks().size(), 2u);
    for (double value : values)
    {
      EXPECT_GT(scale.position(value), scale.lower());
      EXPECT_LT(scale.position(value), scale.upper());
    }
  }
}

/// Pixels of a chart that have a variant's colour.
std::size_t pixelsOf(const Picture& chart, int red, int green, int blue)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < chart.pixelCount(); ++i)
  {
    count +=
      chart.rgb[3 * i] == red && chart.rgb[3 * i + 1] == green && chart.rgb[3 * i + 2] == blue;
  }
  return count;
}

TEST(ReportChart, DrawsTheFrontInColour)
{
  const TestFolder folder;
  const char* const keep = std::getenv("GNOMON_KEEP_CHART"); // a path, for looking at it
  const std::string path = keep ? keep : folder / "chart.png";
  const std::vector<ChartWay> ways = { { "fast", { 5.0, 1.0 } }, { "beaten", { 4.0, 3.0 } },
    { "exact", { 0.0, 2.0 } } };
  writePicture(drawFront(ways, "time", "", "error", " %"), path);
  const Picture chart = readPicture(path);
  // Two markers of some 60 pixels each, their labels, and a marker in grey.
  EXPECT_GT(pixelsOf(chart, 31, 119, 180), 150u);
  EXPECT_GT(pixelsOf(chart, 190, 190, 190), 40u);
  EXPECT_GT(pixelsOf(chart, 255, 255, 255), chart.pixelCount() / 2);
}

} // namespace
} // namespace gnomon::tool
