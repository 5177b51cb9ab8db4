#include "GrowthReport.h"

#include "Files.h"
#include "ImageFile.h"
#include "Panels.h"
#include "ReportChart.h"

#include <vtkVersion.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <optional>
#include <sstream>

namespace gnomon::tool
{
namespace
{

using Points = std::vector<std::array<double, 2>>;
using Cells = std::vector<std::string>;

/// Contenders that are not Gnomon's; they come first.
constexpr std::size_t peerCount = 2;

/// Return a contender's time over x, in the cases that it draws.
Points pointsOf(const GrowthAxis& axis, std::size_t contender)
{
  Points points;
  for (const GrowthRow& row : axis.rows)
  {
    if (row.measured[contender].isDrawn())
    {
      points.push_back({ { row.x, row.measured[contender].milliseconds() } });
    }
  }
  return points;
}

/// Return e of y ~ x^e by least squares in log y; nothing for fewer than two points.
std::optional<double> exponentOf(const Points& points)
{
  const auto meanLog = [&](std::size_t k)
  {
    return std::accumulate(points.begin(), points.end(), 0.0,
             [k](double sum, const auto& point) { return sum + std::log(point[k]); }) /
      static_cast<double>(points.size());
  };
  const double meanX = meanLog(0);
  const double meanY = meanLog(1);
  double xx = 0.0;
  double xy = 0.0;
  for (const auto& [x, y] : points)
  {
    xx += (std::log(x) - meanX) * (std::log(x) - meanX);
    xy += (std::log(x) - meanX) * (std::log(y) - meanY);
  }
  return xx > 0.0 ? std::optional<double>(xy / xx) : std::nullopt;
}

/// Return the exponent between the last two points.
std::optional<double> lastExponentOf(const Points& points)
{
  return exponentOf(points.size() < 2 ? Points() : Points(points.end() - 2, points.end()));
}

/// Return the memory of the snapshot and of the ray tracer's structure, per triangle.
double bytesPerTriangle(const FrameReport& report)
{
  return static_cast<double>(report.bytesOccluders + report.bytesBvh) /
    static_cast<double>(std::max<std::size_t>(1, report.triangles));
}

/// Return "Triangles" for "triangles".
std::string titleOf(const GrowthAxis& axis)
{
  std::string title = axis.key;
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

std::string fixed(double value, int digits)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

/// Return a table of Markdown; the first row is its head.
std::string tableOf(const std::vector<Cells>& rows)
{
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    for (const std::string& cell : rows[i])
    {
      text += "| " + cell + " ";
    }
    text += "|\n";
    for (std::size_t k = 0; i == 0 && k < rows[0].size(); ++k)
    {
      text += k + 1 < rows[0].size() ? "|---" : "|---|\n";
    }
  }
  return text;
}

/// Return a table with a row for each contender and a column for each axis that has a scale.
std::string exponentTable(const Growth& growth)
{
  std::vector<Cells> rows = { { "" } };
  for (const std::string& contender : growth.contenders)
  {
    rows.push_back({ contender });
  }
  for (const GrowthAxis& axis : growth.axes)
  {
    if (axis.hasScale())
    {
      rows[0].push_back(axis.key);
      for (std::size_t i = 0; i < growth.contenders.size(); ++i)
      {
        const Points points = pointsOf(axis, i);
        const auto exponent = exponentOf(points);
        const auto last = lastExponentOf(points);
        rows[i + 1].push_back(
          exponent && last ? fixed(*exponent, 2) + " (" + fixed(*last, 2) + ")" : "");
      }
    }
  }
  return tableOf(rows);
}

/// Return a table with a row for each case and a column for each contender from `first` on.
/// @param cellOf turns a contender's measurement and plain VTK's into a cell's text
template <typename CellOf>
std::string caseTable(
  const Growth& growth, const GrowthAxis& axis, std::size_t first, const CellOf& cellOf)
{
  std::vector<Cells> rows = { { axis.key } };
  for (std::size_t i = first; i < growth.contenders.size(); ++i)
  {
    rows[0].push_back(growth.contenders[i]);
  }
  for (const GrowthRow& row : axis.rows)
  {
    rows.push_back({ row.name });
    for (std::size_t i = first; i < growth.contenders.size(); ++i)
    {
      const GrowthMeasurement& measured = row.measured[i];
      rows.back().push_back(
        measured.isDrawn() ? cellOf(measured, row.measured.front()) : "not drawn");
    }
  }
  return tableOf(rows);
}

/// Return why contenders are not drawn, a line each.
std::string listOfNotDrawn(const Growth& growth, const GrowthAxis& axis)
{
  std::string text;
  for (const GrowthRow& row : axis.rows)
  {
    for (std::size_t i = 0; i < growth.contenders.size(); ++i)
    {
      if (!row.measured[i].isDrawn())
      {
        text +=
          "- " + growth.contenders[i] + ", " + row.name + ": " + row.measured[i].notDrawn + "\n";
      }
    }
  }
  return text.empty() ? "" : "Not drawn:\n\n" + text + "\n";
}

std::string sectionOf(const Growth& growth, const GrowthAxis& axis)
{
  const auto time = [](const GrowthMeasurement& measured, const GrowthMeasurement& plain)
  {
    const std::string ratio = &measured == &plain || !plain.isDrawn()
      ? ""
      : " (" + fixed(measured.milliseconds() / plain.milliseconds(), 2) + ")";
    return fixed(measured.milliseconds(), 1) + " ms" + ratio;
  };
  const auto firstTime = [](const GrowthMeasurement& measured, const GrowthMeasurement&)
  { return fixed(measured.firstMilliseconds, 0) + " ms"; };
  const auto bytes = [](const GrowthMeasurement& measured, const GrowthMeasurement&)
  { return fixed(bytesPerTriangle(measured.report), 1); };
  return "\n## " + titleOf(axis) + "\n\n" + caseTable(growth, axis, 0, time) + "\n" +
    listOfNotDrawn(growth, axis) + "First frame:\n\n" + caseTable(growth, axis, 0, firstTime) +
    (axis.key == "triangles"
        ? "\nBytes per triangle:\n\n" + caseTable(growth, axis, peerCount, bytes)
        : "");
}

std::string toPage(const Growth& growth)
{
  const bool hasScales = std::any_of(
    growth.axes.begin(), growth.axes.end(), [](const GrowthAxis& axis) { return axis.hasScale(); });
  std::string text = "# How a frame's time grows\n\n`" + growth.command +
    "` measures this and writes this page.\n\n";
  if (hasScales)
  {
    text +=
      "A frame's time grows as x^e. The exponents e of each axis x, by least squares over all "
      "cases and, in\nbrackets, between the last two:\n\n" +
      exponentTable(growth) + "\n![Time of a frame over each axis](growth.png)\n\n";
  }
  text += growth.scene + "\n";
  for (const GrowthAxis& axis : growth.axes)
  {
    text += sectionOf(growth, axis);
  }
  return text + "\nMeasured on: " + growth.machine + ".\n";
}

Panel panelOf(const Growth& growth, const GrowthAxis& axis)
{
  std::vector<ChartLine> lines;
  for (std::size_t i = 0; i < growth.contenders.size(); ++i)
  {
    lines.push_back({ growth.contenders[i], pointsOf(axis, i) });
  }
  return { titleOf(axis), drawTimes(lines) };
}

} // namespace

//------------------------------------------------------------------------------
void writeGrowth(const Growth& growth, const std::string& folder)
{
  std::vector<Panel> panels;
  for (const GrowthAxis& axis : growth.axes)
  {
    if (axis.hasScale())
    {
      panels.push_back(panelOf(growth, axis));
    }
  }
  if (!panels.empty())
  {
    writePicture(sideBySide(panels), folder + "/growth.png");
  }
  writeWholeFile(folder + "/growth.md", toPage(growth));
}

} // namespace gnomon::tool
