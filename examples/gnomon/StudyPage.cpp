#include "Study.h"

#include "ErrorFront.h"
#include "Html.h"
#include "ReportChart.h"
#include "StudyTemplate.h" // generated from StudyTemplate.html

#include <algorithm>
#include <iterator>
#include <utility>

namespace gnomon::tool
{
namespace
{

///@{
/// What is good enough while something moves.
constexpr double mostWrongShare = 0.005;
constexpr double mostRootMeanSquare = 0.03;
///@}

constexpr std::size_t mostPlaces = 5;

/// Rows that are shown together, of hard shadows alone or of soft ones.
struct Group
{
  std::string name; ///< "all scenes with hard shadows", "bunny"
  bool isOfAll = false;
  bool soft = false;
  std::vector<StudyRow> rows;
};

std::vector<Group> groupsOf(const std::vector<StudyRow>& rows)
{
  std::vector<Group> groups;
  for (const bool soft : { false, true })
  {
    Group all{ std::string("all scenes with ") + (soft ? "soft" : "hard") + " shadows", true, soft,
      {} };
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(all.rows),
      [&](const StudyRow& row) { return row.of.soft == soft; });
    if (!all.rows.empty())
    {
      groups.push_back(std::move(all));
    }
  }
  for (const StudyRow& row : rows)
  {
    const auto same = std::find_if(
      groups.begin(), groups.end(), [&](const Group& group) { return group.name == row.of.scene; });
    Group& group = same != groups.end()
      ? *same
      : groups.emplace_back(Group{ row.of.scene, false, row.of.soft, {} });
    group.rows.push_back(row);
  }
  return groups;
}

std::vector<StudySummary> frontOf(const std::vector<StudySummary>& summaries, Motion motion)
{
  std::vector<ErrorAndTime> ways;
  for (const StudySummary& summary : summaries)
  {
    ways.push_back({ summary.error, summary.overPlain[static_cast<std::size_t>(motion)] });
  }
  std::vector<StudySummary> front;
  for (const std::size_t way : paretoFront(ways))
  {
    front.push_back(summaries[way]);
  }
  return front;
}

std::string errorText(double error, bool soft)
{
  return soft ? "an RMS error of " + threeDigits(error) : percent(error) + " wrong pixels";
}

std::string timesText(const StudySummary& summary)
{
  const auto times = [&](Motion motion)
  { return fixed(summary.overPlain[static_cast<std::size_t>(motion)], 2); };
  return times(Motion::Static) + " times plain VTK with nothing moving, " + times(Motion::Camera) +
    " with the camera and " + times(Motion::Light) + " with the light moving";
}

/// What to use when.
std::string conclusion(const std::vector<Group>& groups)
{
  std::string html;
  const auto add = [&](const std::string& text) { html += "<p>" + text + "</p>\n"; };
  const auto named = [](const StudySummary& summary)
  { return "<b>" + escape(summary.variant) + "</b>"; };
  for (const Group& group : groups)
  {
    if (!group.isOfAll)
    {
      continue;
    }
    const std::vector<StudySummary> summaries = summarise(group.rows);
    const std::vector<StudySummary> front = frontOf(summaries, Motion::Camera);
    const StudySummary& best = front.back();
    const double enough = group.soft ? mostRootMeanSquare : mostWrongShare;
    const StudySummary& quick = *std::find_if(front.begin(), front.end(),
      [&](const StudySummary& way) { return way.error <= std::max(enough, best.error); });
    add(named(best) + " is the most accurate for " + (group.soft ? "soft" : "hard") +
      " shadows, with " + errorText(best.error, group.soft) + ". It takes " + timesText(best) +
      ".");
    if (quick.variant != best.variant)
    {
      add("Where that is too slow while something moves, " + named(quick) + " shows " +
        errorText(quick.error, group.soft) + " in " + timesText(quick) + ".");
    }
  }
  return html;
}

std::string chartsOf(const std::vector<Group>& groups)
{
  std::string html;
  for (const Group& group : groups)
  {
    const std::vector<StudySummary> summaries = summarise(group.rows);
    for (const Motion motion : allMotions)
    {
      std::vector<ChartWay> ways;
      for (const StudySummary& summary : summaries)
      {
        ways.push_back({ summary.variant,
          { (group.soft ? 1.0 : 100.0) * summary.error,
            summary.overPlain[static_cast<std::size_t>(motion)] } });
      }
      const Picture chart = drawFront(ways, "time per frame over plain VTK's", "",
        group.soft ? "RMS error of visibility" : "wrong pixels", group.soft ? "" : " %");
      html += "<figure data-of=\"" + escape(group.name) + "/" + motionKey(motion) +
        "\"><img alt=\"" + escape(group.name) + ", " + motionName(motion) + "\" src=\"" +
        dataUri(chart) + "\" /></figure>\n";
    }
  }
  return html;
}

std::string option(const std::string& value, const std::string& text)
{
  return "<option value=\"" + escape(value) + "\">" + escape(text) + "</option>";
}

std::string sceneOptions(const std::vector<Group>& groups)
{
  std::string html;
  for (const Group& group : groups)
  {
    html += option(group.name, group.name);
  }
  return html;
}

std::string motionOptions()
{
  std::string html;
  for (const Motion motion : { Motion::Camera, Motion::Light, Motion::Static })
  {
    html += option(motionKey(motion), motion == Motion::Static ? "nothing" : motionName(motion));
  }
  return html;
}

/// The fronts over all scenes, with the camera moving.
std::string tablesOf(const std::vector<Group>& groups)
{
  std::string html;
  for (const Group& group : groups)
  {
    if (!group.isOfAll)
    {
      continue;
    }
    html += "<table>\n" +
      heading(
        { group.soft ? "Soft shadows" : "Hard shadows", group.soft ? "RMS error" : "Wrong pixels",
          "nothing moving", "camera moving", "light moving" }) +
      "<tbody>\n";
    for (const StudySummary& summary : frontOf(summarise(group.rows), Motion::Camera))
    {
      html += "<tr>" + cell(summary.variant) +
        cell(group.soft ? threeDigits(summary.error) : percent(summary.error));
      for (const double times : summary.overPlain)
      {
        html += cell(fixed(times, 2));
      }
      html += "</tr>\n";
    }
    html += "</tbody>\n</table>\n<p></p>\n";
  }
  return html;
}

/// The worst places of the front's ways, of each in the case where it is most wrong.
std::string placesOf(const std::vector<Group>& groups)
{
  std::vector<const StudyRow*> worst;
  for (const Group& group : groups)
  {
    if (!group.isOfAll)
    {
      continue;
    }
    for (const StudySummary& summary : frontOf(summarise(group.rows), Motion::Camera))
    {
      const StudyRow* most = nullptr;
      for (const StudyRow& row : group.rows)
      {
        const bool counts = row.variant == summary.variant && row.worst.pixelCount() > 0 &&
          summary.technique != plainTechnique;
        most = counts && (!most || row.error() > most->error()) ? &row : most;
      }
      if (most)
      {
        worst.push_back(most);
      }
    }
  }
  std::string html;
  for (std::size_t i = 0; i < std::min(worst.size(), mostPlaces); ++i)
  {
    const StudyRow& row = *worst[i];
    const std::string text =
      row.variant + ", " + row.of.name() + ": " + errorText(row.error(), row.of.soft);
    html += "<figure class=\"worst\"><img alt=\"" + escape(text) + "\" src=\"" +
      dataUri(row.worst) + "\" /><figcaption>" + escape(text) + "</figcaption></figure>\n";
  }
  return html;
}

std::string countCases(const std::vector<StudyRow>& rows)
{
  std::vector<std::string> names;
  for (const StudyRow& row : rows)
  {
    if (names.empty() || names.back() != row.of.name())
    {
      names.push_back(row.of.name());
    }
  }
  return std::to_string(names.size()) + (names.size() == 1 ? " case." : " cases.");
}

} // namespace

//------------------------------------------------------------------------------
std::string studyPage(const std::vector<StudyRow>& rows, const std::string& machine)
{
  const std::vector<Group> groups = groupsOf(rows);
  return fillTemplate(StudyTemplate,
    { { "conclusion", conclusion(groups) }, { "scenes", sceneOptions(groups) },
      { "motions", motionOptions() }, { "charts", chartsOf(groups) },
      { "tables", tablesOf(groups) }, { "places", placesOf(groups) }, { "cases", countCases(rows) },
      { "machine", escape(machine) } });
}

} // namespace gnomon::tool
