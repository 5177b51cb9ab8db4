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

/// Return a table with a row for each case of axes without a scale: multiples of plain VTK's time.
std::string ratioTable(const Growth& growth)
{
  std::vector<Cells> rows = { { "" } };
  rows[0].insert(rows[0].end(), growth.contenders.begin() + 1, growth.contenders.end());
  for (const GrowthAxis& axis : growth.axes)
  {
    for (const GrowthRow& row : axis.hasScale() ? std::vector<GrowthRow>() : axis.rows)
    {
      rows.push_back({ row.name });
      for (std::size_t i = 1; i < growth.contenders.size(); ++i)
      {
        rows.back().push_back(row.overPlain(i) ? fixed(*row.overPlain(i), 2) : "not drawn");
      }
    }
  }
  return rows.size() > 1 ? "\nMultiples of plain VTK's time:\n\n" + tableOf(rows) : "";
}

/// Return all figures, a line each.
std::string toCsv(const Growth& growth)
{
  std::string text =
    "axis,case,contender,milliseconds,over plain,first milliseconds,bytes a triangle,not drawn\n";
  for (const GrowthAxis& axis : growth.axes)
  {
    for (const GrowthRow& row : axis.rows)
    {
      for (std::size_t i = 0; i < growth.contenders.size(); ++i)
      {
        const GrowthMeasurement& measured = row.measured[i];
        text += axis.key + ",\"" + row.name + "\"," + growth.contenders[i];
        text += measured.isDrawn() ? "," + fixed(measured.milliseconds(), 2) : ",";
        text += row.overPlain(i) ? "," + fixed(*row.overPlain(i), 3) : ",";
        text += "," + fixed(measured.firstMilliseconds, 1);
        text += i < peerCount ? "," : "," + fixed(bytesPerTriangle(measured.report), 1);
        text += ",\"" + measured.notDrawn + "\"\n";
      }
    }
  }
  return text;
}

std::string toPage(const Growth& growth)
{
  const bool hasScales = std::any_of(
    growth.axes.begin(), growth.axes.end(), [](const GrowthAxis& axis) { return axis.hasScale(); });
  std::string text = "# How a frame's time grows\n\n`" + growth.command +
    "` measures this and writes this page and\n[all figures](growth.csv).\n\n";
  if (hasScales)
  {
    text +=
      "A frame's time grows as x^e. The exponents e of each axis x, by least squares over all "
      "cases and, in\nbrackets, between the last two:\n\n" +
      exponentTable(growth) + "\n![Time of a frame over each axis](growth.png)\n\n";
  }
  return text + growth.scene + "\n" + ratioTable(growth) + "\nMeasured on: " + growth.machine +
    ".\n";
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
std::optional<double> GrowthRow::overPlain(std::size_t contender) const
{
  const GrowthMeasurement& plain = this->measured.front();
  const GrowthMeasurement& own = this->measured[contender];
  return plain.isDrawn() && own.isDrawn()
    ? std::optional<double>(own.milliseconds() / plain.milliseconds())
    : std::nullopt;
}

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
  writeWholeFile(folder + "/growth.csv", toCsv(growth));
  writeWholeFile(folder + "/growth.md", toPage(growth));
}

} // namespace gnomon::tool
