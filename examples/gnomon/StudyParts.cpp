#include "StudyParts.h"

#include "ErrorFront.h"
#include "Html.h"
#include "ReportChart.h"

#include <algorithm>
#include <iterator>

namespace gnomon::tool
{
namespace
{

///@{
/// The errors that are acceptable during motion.
constexpr double mostWrongShare = 0.005;
constexpr double mostRootMeanSquare = 0.03;
///@}

double timeOf(const StudySummary& summary, Motion motion)
{
  return summary.overPlain[static_cast<std::size_t>(motion)];
}

std::string numberOf(double error, bool soft)
{
  return soft ? threeDigits(error) : percent(error);
}

std::string errorText(double error, bool soft)
{
  return soft ? "an RMS error of " + threeDigits(error) : percent(error) + " wrong pixels";
}

/// Return a front's recommendation if its last technique is too slow: the first that is accurate
/// enough, else the last but one.
const StudySummary& quickerOf(const std::vector<StudySummary>& front, bool soft)
{
  const double enough = soft ? mostRootMeanSquare : mostWrongShare;
  const auto found = std::find_if(
    front.begin(), front.end(), [&](const StudySummary& way) { return way.error <= enough; });
  const bool isBest = found == front.end() || found + 1 == front.end();
  return isBest ? front[front.size() - std::min<std::size_t>(front.size(), 2)] : *found;
}

std::string timesText(const StudySummary& summary)
{
  return fixed(timeOf(summary, Motion::Static), 2) +
    " times plain VTK's time with nothing moving, " + fixed(timeOf(summary, Motion::Camera), 2) +
    " with the camera and " + fixed(timeOf(summary, Motion::Light), 2) + " with the light moving";
}

} // namespace

//------------------------------------------------------------------------------
std::vector<StudySummary> frontOf(const std::vector<StudySummary>& summaries, Motion motion)
{
  std::vector<ErrorAndTime> ways;
  for (const StudySummary& summary : summaries)
  {
    ways.push_back({ summary.error, timeOf(summary, motion) });
  }
  std::vector<StudySummary> front;
  for (const std::size_t way : paretoFront(ways))
  {
    front.push_back(summaries[way]);
  }
  return front;
}

//------------------------------------------------------------------------------
std::string conclusionOf(const std::vector<StudySummary>& summaries, bool soft)
{
  const auto named = [](const StudySummary& summary)
  { return "<b>" + escape(summary.variant) + "</b>"; };
  std::vector<StudySummary> shadowed;
  std::copy_if(summaries.begin(), summaries.end(), std::back_inserter(shadowed),
    [](const StudySummary& summary) { return summary.technique != plainTechnique; });
  const std::vector<StudySummary> front = frontOf(shadowed, Motion::Camera);
  const StudySummary& best = front.back();
  const StudySummary& quick = quickerOf(front, soft);
  std::string html = "<p>" + named(best) + " is the most accurate for " + (soft ? "soft" : "hard") +
    " shadows, with " + errorText(best.error, soft) + ". It takes " + timesText(best) + ".</p>\n";
  if (quick.variant != best.variant)
  {
    html += "<p>If that is too slow while the camera moves, " + named(quick) + " shows " +
      errorText(quick.error, soft) + " in " + timesText(quick) + ".</p>\n";
  }
  return html;
}

//------------------------------------------------------------------------------
std::string frontTable(const std::vector<StudySummary>& summaries, bool soft, std::size_t most)
{
  std::vector<StudySummary> front = frontOf(summaries, Motion::Camera);
  front.erase(
    front.begin(), front.end() - static_cast<std::ptrdiff_t>(std::min(front.size(), most)));
  std::string html = "<table>\n" +
    heading({ soft ? "Soft shadows" : "Hard shadows", soft ? "RMS error" : "Wrong pixels",
      "nothing moving", "camera moving", "light moving" }) +
    "<tbody>\n";
  for (const StudySummary& summary : front)
  {
    html += "<tr>" + cell(summary.variant) + cell(numberOf(summary.error, soft));
    for (const double times : summary.overPlain)
    {
      html += cell(fixed(times, 2));
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

//------------------------------------------------------------------------------
Picture frontChart(const std::vector<StudySummary>& summaries, bool soft, Motion motion)
{
  std::vector<ChartWay> ways;
  for (const StudySummary& summary : summaries)
  {
    ways.push_back(
      { summary.variant, { (soft ? 1.0 : 100.0) * summary.error, timeOf(summary, motion) } });
  }
  const std::string moving =
    motion == Motion::Static ? "nothing moving" : std::string("the ") + motionName(motion);
  return drawFront(ways, "time per frame over plain VTK's, " + moving, "",
    soft ? "RMS error of visibility" : "wrong pixels", soft ? "" : " %");
}

//------------------------------------------------------------------------------
std::string worstPlaces(
  const std::vector<StudyRow>& rows, const std::vector<StudySummary>& variants, std::size_t most)
{
  std::string html;
  std::size_t count = 0;
  for (const StudySummary& variant : variants)
  {
    const StudyRow* worst = nullptr;
    for (const StudyRow& row : rows)
    {
      const bool counts = row.variant == variant.variant && row.worst.pixelCount() > 0;
      worst = counts && (!worst || row.error() > worst->error()) ? &row : worst;
    }
    if (!worst || variant.technique == plainTechnique || count == most)
    {
      continue;
    }
    ++count;
    const std::string text = escape(
      worst->variant + ", " + worst->of.name() + ": " + errorText(worst->error(), worst->of.soft));
    html += "<figure class=\"worst\"><img alt=\"" + text + "\" src=\"" + dataUri(worst->worst) +
      "\" /><figcaption>" + text + "</figcaption></figure>\n";
  }
  return html;
}

} // namespace gnomon::tool
