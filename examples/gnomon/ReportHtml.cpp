#include "Report.h"

#include "Html.h"
#include "ReportTemplate.h" // generated from ReportTemplate.html

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tool
{
namespace
{

/// A share of the pixels that count, with the number of pixels below.
std::string pixelCell(const VisibilityError& error, std::int64_t pixels)
{
  return cell(percent(error.share(pixels)), std::to_string(pixels));
}

std::string errorTable(const ComparisonResults& results)
{
  const auto plain = std::find_if(results.variants.begin(), results.variants.end(),
    [](const VariantResult& variant) { return variant.technique == plainTechnique; });
  const std::vector<Motion> motions = timedMotions(results);
  std::vector<std::string> columns = { "Variant", "Wrong pixels", "False light", "False shadow",
    "Mean error", "RMS error", "Neither lit nor dark", "Traced" };
  for (Motion motion : motions)
  {
    columns.push_back(std::string("Frame, ") + motionName(motion));
  }
  columns.push_back("Memory");
  std::string html = "<table>\n" + heading(columns) + "<tbody>\n";
  for (const VariantResult& variant : results.variants)
  {
    const VisibilityError& error = variant.error;
    html += "<tr>" + cell(variant.name) + pixelCell(error, error.wrongPixels()) +
      pixelCell(error, error.falseLight) + pixelCell(error, error.falseShadow) +
      cell(threeDigits(error.meanAbsolute)) + cell(threeDigits(error.rootMeanSquare)) +
      pixelCell(error, error.betweenPixels) + pixelCell(error, variant.tracedPixels);
    for (Motion motion : motions)
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

std::string stageTable(const ComparisonResults& results)
{
  const std::vector<std::string> names =
    stageNames(results, { allMotions.begin(), allMotions.end() });
  if (names.empty())
  {
    return results.frames > 0 ? "<p>No variant has stages.</p>" : notTimed;
  }
  std::vector<std::string> columns = { "Variant", "Motion" };
  columns.insert(columns.end(), names.begin(), names.end());
  columns.push_back("Explained");
  std::string html = "<table>\n" + heading(columns) + "<tbody>\n";
  for (const VariantResult& variant : results.variants)
  {
    for (Motion motion : allMotions)
    {
      const MotionTiming& timing = variant.timings[static_cast<std::size_t>(motion)];
      if (timing.stages.empty())
      {
        continue;
      }
      html += "<tr>" + cell(variant.name) + cell(motionName(motion));
      for (const std::string& name : names)
      {
        const double* const milliseconds = findNamed(timing.stages, name);
        html += cell(milliseconds ? fixed(*milliseconds, 2) : std::string());
      }
      html += cell(fixed(100.0 * timing.stageShare, 0) + " %") + "</tr>\n";
    }
  }
  return html + "</tbody>\n</table>";
}

/// How pixels were decided, with the classes' shares of all pixels of all lights.
std::string classTable(const ComparisonResults& results)
{
  const std::vector<std::string> names = classNames(results);
  if (names.empty())
  {
    return "<p>No variant tells its pixels' classes.</p>";
  }
  std::vector<std::string> columns = { "Variant" };
  columns.insert(columns.end(), names.begin(), names.end());
  std::string html = "<table>\n" + heading(columns) + "<tbody>\n";
  const double pixelsOfAll = static_cast<double>(results.width) * results.height * results.lights;
  for (const VariantResult& variant : results.variants)
  {
    if (variant.classes.empty())
    {
      continue;
    }
    html += "<tr>" + cell(variant.name);
    for (const std::string& name : names)
    {
      const std::int64_t* const pixels = findNamed(variant.classes, name);
      html += pixels
        ? cell(percent(static_cast<double>(*pixels) / pixelsOfAll), std::to_string(*pixels))
        : cell(std::string());
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>";
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
  return chart.pixelCount() > 0
    ? "<figure><img alt=\"Chart: wrong pixels against time per frame\" src=\"" + dataUri(chart) +
      "\" /></figure>"
    : notTimed;
}

std::string pictureGrid(const ComparisonResults& results)
{
  std::string html;
  for (const VariantResult& variant : results.variants)
  {
    const std::string name = escape(variant.name);
    const std::string wrong = percent(variant.error.share(variant.error.wrongPixels()));
    html += "<div class=\"pair\">\n<h3>" + name + "</h3>\n<figure><img alt=\"" + name +
      "\" src=\"" + dataUri(variant.picture) + "\" /></figure>\n<figure><img alt=\"" + name +
      ": errors\" src=\"" + dataUri(variant.errors) + "\" /><figcaption>" + wrong +
      " wrong pixels</figcaption></figure>\n";
    if (variant.classPicture.pixelCount() > 0)
    {
      html += "<figure><img alt=\"" + name + ": classes\" src=\"" + dataUri(variant.classPicture) +
        "\" /><figcaption>How pixels were decided</figcaption></figure>\n";
    }
    html += "</div>\n";
  }
  return html;
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
      { "truth", escape(results.truth) },
      { "table", errorTable(results) },
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
