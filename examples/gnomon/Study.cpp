#include "Study.h"

#include "CsvRow.h"
#include "Errors.h"
#include "Files.h"
#include "FrameVariant.h"
#include "Report.h"
#include "VtkMessages.h"

#include "shadowtech/Registry.h"

#include <nlohmann/json.hpp>

#include <vtkTransform.h>

#include <algorithm>
#include <filesystem>

namespace gnomon::tool
{
namespace
{

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* rowsFile = "rows.json";

/// Return a scene's camera, turned about its target: by 25 degrees to one side, to the other side,
/// by 50 degrees, and so on.
SceneCamera turnedTo(const SceneCamera& camera, int view)
{
  constexpr double stepDegrees = 25.0;
  const double degrees = stepDegrees * ((view + 1) / 2) * (view % 2 == 0 ? -1.0 : 1.0);
  vtkNew<vtkTransform> turn;
  turn->Translate(camera.target.data());
  turn->RotateWXYZ(degrees, camera.up.data());
  turn->Translate(-camera.target[0], -camera.target[1], -camera.target[2]);
  SceneCamera turned = camera;
  turn->TransformPoint(camera.position.data(), turned.position.data());
  return turned;
}

/// Return the settings that a case's numbers depend on.
Json describe(const StudyCase& of, const ComparisonPlan& plan)
{
  return { { "scene", of.scene }, { "view", of.view }, { "version", GNOMON_VERSION },
    { "techniques", plan.techniques }, { "settings", plan.settings },
    { "map_sizes", plan.mapSizesTexels }, { "width", plan.width }, { "height", plan.height },
    { "frames", plan.frames }, { "truth_samples", plan.truthSamples } };
}

fs::path folderOf(const std::string& folder, const StudyCase& of)
{
  return fs::path(folder) / fileStem(of.name());
}

/// Return a variant's name without its route. Techniques of a study take their usual route.
std::string withoutRoute(const VariantResult& variant)
{
  const std::string ending = " " + variant.route;
  return variant.route.empty() ? variant.name
                               : variant.name.substr(0, variant.name.size() - ending.size());
}

std::string worstFile(const StudyRow& row)
{
  return fileStem(row.variant) + ".png";
}

/// Write a case's folder. The file that marks it complete is written last.
void writeCase(const fs::path& folder, const std::vector<StudyRow>& rows, const Json& how)
{
  fs::create_directories(folder);
  fs::remove(folder / rowsFile);
  Json json = { { "how", how }, { "rows", Json::array() } };
  for (const StudyRow& row : rows)
  {
    json["rows"].push_back({ { "variant", row.variant }, { "technique", row.technique },
      { "wrong_share", row.wrongShare }, { "rms_error", row.rootMeanSquare },
      { "mean_absolute_error", row.meanAbsolute }, { "milliseconds", row.milliseconds },
      { "over_plain", row.overPlain }, { "worst", row.worst.pixelCount() > 0 } });
    if (row.worst.pixelCount() > 0)
    {
      writePicture(row.worst, (folder / worstFile(row)).string());
    }
  }
  writeWholeFile((folder / rowsFile).string(), json.dump(2) + "\n");
}

/// Return the rows of a finished case with the same settings; none if its settings differ.
/// @throws Json::exception, BadInput if a file is missing or damaged
std::vector<StudyRow> readCase(const fs::path& folder, const StudyCase& of, const Json& how)
{
  constexpr std::size_t largestBytes = 1 << 24;
  const fs::path file = folder / rowsFile;
  const Json json = Json::parse(readWholeFile(file.string(), largestBytes));
  if (json.at("how") != how)
  {
    return {};
  }
  std::vector<StudyRow> rows;
  for (const Json& from : json.at("rows"))
  {
    StudyRow row;
    row.of = of;
    row.variant = from.at("variant");
    row.technique = from.at("technique");
    row.wrongShare = from.at("wrong_share");
    row.rootMeanSquare = from.at("rms_error");
    row.meanAbsolute = from.at("mean_absolute_error");
    row.milliseconds = from.at("milliseconds");
    row.overPlain = from.at("over_plain");
    if (from.at("worst"))
    {
      row.worst = readPicture((folder / worstFile(row)).string());
    }
    rows.push_back(row);
  }
  return rows;
}

/// Return a finished case's rows, as readCase() does; none if a file is missing or damaged, as
/// after an interruption.
std::vector<StudyRow> rowsMadeBefore(const fs::path& folder, const StudyCase& of, const Json& how)
{
  try
  {
    return readCase(folder, of, how);
  }
  catch (const Json::exception&)
  {
    return {};
  }
  catch (const BadInput&)
  {
    return {};
  }
}

std::vector<StudyCase> casesOf(const StudyPlan& plan)
{
  std::vector<StudyCase> cases;
  for (const std::string& name : plan.scenes)
  {
    const bool soft = castsSoftShadows(plan.comparison, loadScene(name));
    for (int view = 0; view < plan.views; ++view)
    {
      cases.push_back({ name, view, soft });
    }
  }
  return cases;
}

/// Return the comparison of a case.
ComparisonPlan comparisonOf(const StudyPlan& plan, const StudyCase& of)
{
  ComparisonPlan comparison = plan.comparison;
  comparison.usualRoute = true;
  if (!of.soft)
  {
    comparison.techniques = plan.hardTechniques;
    return comparison;
  }
  comparison.techniques.clear();
  for (const std::string& technique : plan.softTechniques)
  {
    const VariantSpec spec = parseTechnique(technique);
    if (spec.settings.count("light_samples") != 0 ||
      !has(estimatorOf(settingsOf(spec)).info, "light_samples"))
    {
      comparison.techniques.push_back(technique);
      continue;
    }
    for (const int samples : plan.lightSamples)
    {
      const bool isDefault = samples == ShadowSettings().lightSamples;
      comparison.techniques.push_back(
        isDefault ? technique : technique + ":light_samples=" + std::to_string(samples));
    }
  }
  return comparison;
}

std::vector<StudyRow> runCase(const StudyCase& of, const ComparisonPlan& plan,
  const std::function<void(double, const std::string&)>& progress)
{
  Scene scene = loadScene(of.scene);
  scene.camera = turnedTo(scene.camera, of.view);
  ComparisonEvents events;
  events.progress = progress;
  const VtkMessages messages;
  const ComparisonResults results = runComparison(scene, plan, events);
  if (!messages.errors().empty())
  {
    throw Failure(messages.errors().front());
  }
  std::vector<StudyRow> rows = rowsOf(of, results);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    rows[i].variant = withoutRoute(results.variants[i]);
  }
  return rows;
}

/// Run a case as runCase() does, with errors that name the case.
std::vector<StudyRow> runNamed(const StudyCase& of, const ComparisonPlan& plan,
  const std::function<void(double, const std::string&)>& progress)
{
  try
  {
    return runCase(of, plan, progress);
  }
  catch (const BadInput& error)
  {
    throw BadInput(of.name() + ": " + error.what());
  }
  catch (const Failure& error)
  {
    throw Failure(of.name() + ": " + error.what());
  }
}

} // namespace

//------------------------------------------------------------------------------
std::vector<StudyRow> runStudy(const StudyPlan& plan, const std::string& folder,
  const std::function<void(double share, const std::string& step)>& progress)
{
  const std::vector<StudyCase> cases = casesOf(plan);
  std::vector<StudyRow> rows;
  double done = 0.0;
  for (const StudyCase& of : cases)
  {
    const ComparisonPlan comparison = comparisonOf(plan, of);
    const Json how = describe(of, comparison);
    const fs::path caseFolder = folderOf(folder, of);
    std::vector<StudyRow> ofCase = rowsMadeBefore(caseFolder, of, how);
    if (ofCase.empty())
    {
      ofCase = runNamed(of, comparison,
        [&](double share, const std::string& step)
        { progress((done + share) / static_cast<double>(cases.size()), of.name() + ", " + step); });
      writeCase(caseFolder, ofCase, how);
    }
    rows.insert(rows.end(), ofCase.begin(), ofCase.end());
    ++done;
  }
  return rows;
}

//------------------------------------------------------------------------------
std::string toCsv(const std::vector<StudyRow>& rows)
{
  CsvRow head;
  head << std::string("scene") << std::string("shadows") << std::string("view")
       << std::string("variant") << std::string("technique") << std::string("wrong_share")
       << std::string("rms_error") << std::string("mean_absolute_error");
  for (const Motion motion : allMotions)
  {
    head << motionKey(motion) + "_ms" << motionKey(motion) + "_over_plain";
  }
  std::string text = head.line();
  for (const StudyRow& row : rows)
  {
    CsvRow line;
    line << row.of.scene << std::string(row.of.soft ? "soft" : "hard")
         << std::int64_t(row.of.view + 1) << row.variant << row.technique << row.wrongShare
         << row.rootMeanSquare << row.meanAbsolute;
    for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
    {
      line << row.milliseconds[motion] << row.overPlain[motion];
    }
    text += line.line();
  }
  return text;
}

} // namespace gnomon::tool
