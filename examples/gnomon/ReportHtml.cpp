#include "Report.h"

#include "Html.h"
#include "ReportTemplate.h" // generated from ReportTemplate.html
#include "StudyParts.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tool
{
namespace
{

/// Return a cell with a share of the pixels that count, and the number of pixels below it.
std::string pixelCell(const VisibilityError& error, std::int64_t pixels)
{
  return cell(percent(error.share(pixels)), std::to_string(pixels));
}

std::string errorTable(const ComparisonResults& results)
{
  std::string html = "<table>\n" +
    heading({ "Variant", "Wrong pixels", "False light", "False shadow", "Mean error", "RMS error",
      "Neither lit nor dark", "Traced" }) +
    "<tbody>\n";
  for (const VariantResult& variant : results.variants)
  {
    const VisibilityError& error = variant.error;
    html += "<tr>" + cell(variant.name) + pixelCell(error, error.wrongPixels()) +
      pixelCell(error, error.falseLight) + pixelCell(error, error.falseShadow) +
      cell(threeDigits(error.meanAbsolute)) + cell(threeDigits(error.rootMeanSquare)) +
      pixelCell(error, error.betweenPixels) + pixelCell(error, variant.tracedPixels) + "</tr>\n";
  }
  return html + "</tbody>\n</table>";
}

/// Return the table of times and memory.
std::string costTable(const ComparisonResults& results)
{
  const auto plain = std::find_if(results.variants.begin(), results.variants.end(),
    [](const VariantResult& variant) { return variant.technique == plainTechnique; });
  const std::vector<Motion> motions = timedMotions(results);
  std::vector<std::string> columns = { "Variant" };
  for (const Motion motion : motions)
  {
    columns.push_back(std::string("Frame, ") + motionName(motion));
  }
  columns.push_back("Memory");
  std::string html = "<table>\n" + heading(columns) + "<tbody>\n";
  for (const VariantResult& variant : results.variants)
  {
    html += "<tr>" + cell(variant.name);
    for (const Motion motion : motions)
    {
      const auto index = static_cast<std::size_t>(motion);
      const double milliseconds = variant.timings[index].milliseconds;
      const double reference =
        plain != results.variants.end() ? plain->timings[index].milliseconds : 0.0;
      html += cell(fixed(milliseconds, 1) + " ms",
        reference > 0.0 ? fixed(milliseconds / reference, 2) + " x plain" : std::string());
    }
    const VariantMemory& memory = variant.memory;
    html +=
      cell(
        megabytes(static_cast<double>(memory.occluders + memory.bvh + memory.maps + memory.images)),
        "grew by " + megabytes(static_cast<double>(memory.residentGrowth))) +
      "</tr>\n";
  }
  return html + "</tbody>\n</table>";
}

constexpr const char* notTimed = "<p>No frames were timed.</p>";

/// Return a text such as "maps 8.25, shading 26.50".
template <typename Number, typename Write>
std::string listOf(const std::vector<std::pair<std::string, Number>>& numbers, const Write& write)
{
  std::string text;
  for (const auto& [name, number] : numbers)
  {
    text += (text.empty() ? "" : ", ") + name + " " + write(number);
  }
  return text;
}

std::string stageTable(const ComparisonResults& results)
{
  std::string rows;
  for (const VariantResult& variant : results.variants)
  {
    for (const Motion motion : allMotions)
    {
      const MotionTiming& timing = variant.timings[static_cast<std::size_t>(motion)];
      if (!timing.stages.empty())
      {
        rows += "<tr>" + cell(variant.name) + cell(motionName(motion)) +
          cell(listOf(timing.stages, [](double ms) { return fixed(ms, 2); })) +
          cell(fixed(100.0 * timing.stageShare, 0) + " %") + "</tr>\n";
      }
    }
  }
  if (rows.empty())
  {
    return results.frames > 0 ? "<p>No variant has stages.</p>" : notTimed;
  }
  return "<table class=\"text\">\n" + heading({ "Variant", "Motion", "Stages", "Explained" }) +
    "<tbody>\n" + rows + "</tbody>\n</table>";
}

/// Return the table of pixel classes, as shares of all pixels of all lights.
std::string classTable(const ComparisonResults& results)
{
  const double pixelsOfAll = static_cast<double>(results.width) * results.height * results.lights;
  std::string rows;
  for (const VariantResult& variant : results.variants)
  {
    if (!variant.classes.empty())
    {
      rows += "<tr>" + cell(variant.name) +
        cell(listOf(variant.classes,
          [&](std::int64_t pixels)
          { return percent(static_cast<double>(pixels) / pixelsOfAll); })) +
        "</tr>\n";
    }
  }
  if (rows.empty())
  {
    return "<p>No variant has pixel classes.</p>";
  }
  return "<table class=\"text\">\n" + heading({ "Variant", "Pixels" }) + "<tbody>\n" + rows +
    "</tbody>\n</table>";
}

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string textTable(const Rows& rows)
{
  std::string html = "<table class=\"text\">\n<tbody>\n";
  for (const auto& [name, text] : rows)
  {
    html += "<tr>" + cell(name) + cell(text) + "</tr>\n";
  }
  return html + "</tbody>\n</table>";
}

std::string sourceTable(const ComparisonResults& results)
{
  Rows rows;
  for (const VariantResult& variant : results.variants)
  {
    rows.emplace_back(variant.name, variant.errorSource);
  }
  return textTable(rows);
}

std::string noteList(const ComparisonResults& results)
{
  std::string items;
  for (const std::string& note : results.notes)
  {
    items += "<li>" + escape(note) + "</li>\n";
  }
  for (const VariantResult& variant : results.variants)
  {
    for (const std::string& note : variant.notes)
    {
      items += "<li><b>" + escape(variant.name) + "</b>: " + escape(note) + "</li>\n";
    }
  }
  return items.empty() ? std::string() : "<ul>\n" + items + "</ul>\n";
}

std::string chartFigure(const Picture& chart)
{
  return chart.pixelCount() > 0 ? "<figure><img alt=\"Chart: error over time per frame\" src=\"" +
      dataUri(chart) + "\" /></figure>"
                                : notTimed;
}

std::string pictureGrid(const ComparisonResults& results)
{
  constexpr int mostPixels = 400;
  std::string html;
  for (const VariantResult& variant : results.variants)
  {
    const auto figure = [&](const Picture& picture, const std::string& caption)
    {
      return "<figure><img alt=\"" + escape(variant.name + ": " + caption) + "\" src=\"" +
        dataUri(reduced(picture, mostPixels)) + "\" /><figcaption>" + escape(caption) +
        "</figcaption></figure>\n";
    };
    html += "<h3>" + escape(variant.name) + "</h3>\n<div class=\"pictures\">\n" +
      figure(variant.picture, "picture") +
      figure(variant.errors,
        percent(variant.error.share(variant.error.wrongPixels())) + " wrong pixels");
    if (variant.classPicture.pixelCount() > 0)
    {
      html += figure(variant.classPicture, "how pixels were decided");
    }
    html += "</div>\n";
  }
  return html;
}

/// Return the page's first screen: recommendations, five rows and the worst places.
std::string firstScreen(const ComparisonResults& results)
{
  constexpr std::size_t most = 5;
  const std::vector<StudyRow> rows = rowsOf({ results.scene, -1, results.soft }, results);
  std::vector<StudySummary> summaries = summarise(rows);
  if (results.frames == 0)
  {
    std::stable_sort(summaries.begin(), summaries.end(),
      [](const StudySummary& a, const StudySummary& b) { return a.error > b.error; });
    return std::string(notTimed) + "<div class=\"places\">\n" + worstPlaces(rows, summaries, most) +
      "</div>\n";
  }
  std::vector<StudySummary> shown = frontOf(summaries, Motion::Camera);
  const std::size_t ofFront = shown.size();
  for (const StudySummary& summary : summaries)
  {
    const bool isThere =
      std::any_of(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(ofFront),
        [&](const StudySummary& of) { return of.variant == summary.variant; });
    if (!isThere)
    {
      shown.push_back(summary);
    }
  }
  return conclusionOf(summaries, results.soft) + frontTable(summaries, results.soft, most) +
    "<div class=\"places\">\n" + worstPlaces(rows, shown, most) + "</div>\n";
}

std::string summary(const ComparisonResults& results)
{
  return std::to_string(results.triangles) + " triangles, " + std::to_string(results.lights) +
    (results.lights == 1 ? " light that casts shadows, " : " lights that cast shadows, ") +
    std::to_string(results.width) + " x " + std::to_string(results.height) + " pixels, " +
    std::to_string(results.variants.size()) + " variants.";
}

} // namespace

//------------------------------------------------------------------------------
std::string toHtml(const ComparisonResults& results, const Picture& chart)
{
  return fillTemplate(ReportTemplate,
    {
      { "scene", escape(results.scene) },
      { "summary", escape(summary(results)) },
      { "first", firstScreen(results) },
      { "truth", escape(results.truth) },
      { "errors", errorTable(results) },
      { "costs", costTable(results) },
      { "notes", noteList(results) },
      { "dark", fixed(static_cast<double>(VisibilityError::darkBelow), 1) },
      { "lit", fixed(static_cast<double>(VisibilityError::litAbove), 1) },
      { "frames", std::to_string(results.frames) },
      { "chart", chartFigure(chart) },
      { "pictures", pictureGrid(results) },
      { "stages", stageTable(results) },
      { "classes", classTable(results) },
      { "sources", sourceTable(results) },
      { "settings", textTable(results.settings) },
    });
}

} // namespace gnomon::tool
