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
#include <cmath>
#include <filesystem>
#include <map>

namespace gnomon::tool
{
namespace
{

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* rowsFile = "rows.json";

/// How large a pixel is in the pictures of the worst places.
constexpr int enlargement = 3;

/// A scene's camera, turned about its target: 25 degrees to one side, to the other side, 50 degrees,
/// and so on.
SceneCamera cameraOf(const SceneCamera& camera, int view)
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

/// What a case's numbers depend on, beside the case.
Json describe(const ComparisonPlan& plan)
{
  return { { "version", GNOMON_VERSION }, { "techniques", plan.techniques },
    { "settings", plan.settings }, { "map_sizes", plan.mapSizesTexels }, { "width", plan.width },
    { "height", plan.height }, { "frames", plan.frames }, { "truth_samples", plan.truthSamples },
    { "tracer", plan.tracer }, { "rasterizer", plan.rasterizer } };
}

fs::path folderOf(const std::string& folder, const StudyCase& of)
{
  return fs::path(folder) / fileStem(of.name());
}

/// Two pictures of one height with a white strip between them.
Picture joined(const Picture& left, const Picture& right)
{
  constexpr int gap = 6;
  Picture result;
  result.width = left.width + gap + right.width;
  result.height = left.height;
  for (int y = 0; y < result.height; ++y)
  {
    const auto addRow = [&](const Picture& from)
    {
      const auto row = from.rgb.begin() + static_cast<std::ptrdiff_t>(3 * y * from.width);
      result.rgb.insert(result.rgb.end(), row, row + 3 * from.width);
    };
    addRow(left);
    result.rgb.insert(result.rgb.end(), 3 * gap, 255);
    addRow(right);
  }
  return result;
}

/// All pointwise techniques of a study take the inline route.
std::string withoutRoute(const VariantResult& variant)
{
  const std::string ending = " " + variant.route;
  return variant.route.empty() ? variant.name
                               : variant.name.substr(0, variant.name.size() - ending.size());
}

std::vector<StudyRow> rowsOf(const StudyCase& of, const ComparisonResults& results)
{
  const auto find = [&](const std::string& name) -> const VariantResult&
  {
    return *std::find_if(results.variants.begin(), results.variants.end(),
      [&](const VariantResult& variant) { return variant.name == name; });
  };
  const VariantResult& plain = find(plainTechnique);
  const VariantResult& truth = find(results.truth);
  std::vector<StudyRow> rows;
  for (const VariantResult& variant : results.variants)
  {
    StudyRow row;
    row.of = of;
    row.variant = withoutRoute(variant);
    row.technique = variant.technique;
    row.wrongShare = variant.error.share(variant.error.wrongPixels());
    row.rootMeanSquare = variant.error.rootMeanSquare;
    row.meanAbsolute = variant.error.meanAbsolute;
    for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
    {
      row.milliseconds[motion] = variant.timings[motion].milliseconds;
      row.overPlain[motion] = row.milliseconds[motion] / plain.timings[motion].milliseconds;
    }
    if (variant.worst)
    {
      row.worst = joined(enlarged(truth.picture, *variant.worst, enlargement),
        enlarged(variant.picture, *variant.worst, enlargement));
    }
    rows.push_back(row);
  }
  return rows;
}

std::string worstFile(const StudyRow& row)
{
  return fileStem(row.variant) + ".png";
}

/// Writes a case's folder. What says that it is whole comes last.
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
  writeText((folder / rowsFile).string(), json.dump(2) + "\n");
}

/// The rows of a case that was made before in the same way; none if it was not.
std::vector<StudyRow> readCase(const fs::path& folder, const StudyCase& of, const Json& how)
{
  constexpr std::size_t largestBytes = 1 << 24;
  const fs::path file = folder / rowsFile;
  if (!fs::exists(file))
  {
    return {};
  }
  const Json json = Json::parse(readWholeFile(file.string(), largestBytes), nullptr, false);
  if (json.is_discarded() || json.value("how", Json()) != how)
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

/// What is compared in a case.
ComparisonPlan comparisonOf(const StudyPlan& plan, const StudyCase& of)
{
  ComparisonPlan comparison = plan.comparison;
  comparison.inlineRoute = true;
  comparison.imageRoute = false;
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
  scene.camera = cameraOf(scene.camera, of.view);
  ComparisonEvents events;
  events.progress = progress;
  const VtkMessages messages;
  const ComparisonResults results = runComparison(scene, plan, events);
  if (!messages.errors().empty())
  {
    throw Failure("drawing " + of.name() + ": " + messages.errors().front());
  }
  return rowsOf(of, results);
}

} // namespace

//------------------------------------------------------------------------------
std::string StudyCase::name() const
{
  return this->scene + ", view " + std::to_string(this->view + 1);
}

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
    const Json how = describe(comparison);
    const fs::path caseFolder = folderOf(folder, of);
    std::vector<StudyRow> ofCase = readCase(caseFolder, of, how);
    if (ofCase.empty())
    {
      ofCase = runCase(of, comparison,
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
std::vector<StudySummary> summarise(const std::vector<StudyRow>& rows)
{
  std::vector<std::string> order;
  std::map<std::string, std::vector<const StudyRow*>> ofVariants;
  std::size_t cases = 0;
  for (const StudyRow& row : rows)
  {
    std::vector<const StudyRow*>& ofVariant = ofVariants[row.variant];
    if (ofVariant.empty())
    {
      order.push_back(row.variant);
    }
    ofVariant.push_back(&row);
    cases = std::max(cases, ofVariant.size());
  }
  std::vector<StudySummary> summaries;
  for (const std::string& variant : order)
  {
    const std::vector<const StudyRow*>& ofVariant = ofVariants[variant];
    if (ofVariant.size() < cases)
    {
      continue;
    }
    StudySummary summary{ variant, ofVariant.front()->technique };
    const auto count = static_cast<double>(cases);
    for (const StudyRow* row : ofVariant)
    {
      summary.error += row->error() / count;
    }
    for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
    {
      double logarithms = 0.0;
      for (const StudyRow* row : ofVariant)
      {
        logarithms += std::log(row->overPlain[motion]);
      }
      summary.overPlain[motion] = std::exp(logarithms / count);
    }
    summaries.push_back(summary);
  }
  return summaries;
}

//------------------------------------------------------------------------------
std::string toCsv(const std::vector<StudyRow>& rows)
{
  CsvRow head;
  head << std::string("scene") << std::string("view") << std::string("variant")
       << std::string("technique") << std::string("wrong_share") << std::string("rms_error")
       << std::string("mean_absolute_error");
  for (const Motion motion : allMotions)
  {
    head << motionKey(motion) + "_ms" << motionKey(motion) + "_over_plain";
  }
  std::string text = head.line();
  for (const StudyRow& row : rows)
  {
    CsvRow line;
    line << row.of.scene << std::int64_t(row.of.view + 1) << row.variant << row.technique
         << row.wrongShare << row.rootMeanSquare << row.meanAbsolute;
    for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
    {
      line << row.milliseconds[motion] << row.overPlain[motion];
    }
    text += line.line();
  }
  return text;
}

} // namespace gnomon::tool
