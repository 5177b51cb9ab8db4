#include "Study.h"

#include "Html.h"
#include "StudyParts.h"
#include "StudyTemplate.h" // generated from StudyTemplate.html

#include <algorithm>
#include <iterator>
#include <utility>

namespace gnomon::tool
{
namespace
{

/// The most places of hard shadows, and of soft shadows.
constexpr std::size_t mostPlaces = 4;

/// Rows that are shown together: only hard shadows or only soft shadows.
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

/// Return the texts of `tell` for the groups of all scenes.
template <typename Tell>
std::string ofAllScenes(const std::vector<Group>& groups, const Tell& tell)
{
  std::string html;
  for (const Group& group : groups)
  {
    html += group.isOfAll ? tell(group, summarise(group.rows)) : std::string();
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
      html += "<figure data-of=\"" + escape(group.name) + "/" + motionKey(motion) +
        "\"><img alt=\"" + escape(group.name) + ", " + motionName(motion) + "\" src=\"" +
        dataUri(frontChart(summaries, group.soft, motion)) + "\" /></figure>\n";
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
  const auto conclude = [](const Group& group, const std::vector<StudySummary>& summaries)
  { return conclusionOf(summaries, group.soft); };
  const auto tabulate = [](const Group& group, const std::vector<StudySummary>& summaries)
  { return frontTable(summaries, group.soft, summaries.size()) + "<p></p>\n"; };
  const auto showPlaces = [](const Group& group, const std::vector<StudySummary>& summaries)
  { return worstPlaces(group.rows, frontOf(summaries, Motion::Camera), mostPlaces); };
  return fillTemplate(StudyTemplate,
    { { "conclusion", ofAllScenes(groups, conclude) }, { "scenes", sceneOptions(groups) },
      { "motions", motionOptions() }, { "charts", chartsOf(groups) },
      { "tables", ofAllScenes(groups, tabulate) }, { "places", ofAllScenes(groups, showPlaces) },
      { "cases", countCases(rows) }, { "machine", escape(machine) } });
}

} // namespace gnomon::tool
