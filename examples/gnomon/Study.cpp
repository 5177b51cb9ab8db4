#include "Study.h"

#include "Errors.h"
#include "Files.h"
#include "FrameVariant.h"
#include "VtkMessages.h"

#include "shadowtech/Registry.h"

#include <vtkTransform.h>

#include <filesystem>
#include <regex>

namespace gnomon::tool
{

namespace
{

/// A scene from a view.
struct Case
{
  std::string name; ///< "bunny, view 2"
  std::string scene;
  int view = 1;
  ComparisonPlan plan;

  /// Return the settings that its numbers depend on.
  nlohmann::ordered_json settings() const
  {
    return { { "scene", this->scene }, { "view", this->view }, { "version", GNOMON_VERSION },
      { "techniques", this->plan.techniques }, { "settings", this->plan.settings },
      { "map_sizes", this->plan.mapSizesTexels }, { "width", this->plan.width },
      { "height", this->plan.height }, { "frames", this->plan.frames },
      { "truth_samples", this->plan.truthSamples } };
  }
};

/// Return a technique with each number of samples of area lights, if it samples them.
std::vector<std::string> sampled(const std::string& technique, const std::vector<int>& lightSamples)
{
  const VariantSpec spec = parseTechnique(technique);
  if (spec.settings.count("light_samples") != 0 ||
    !has(estimatorOf(settingsOf(spec)).info, "light_samples"))
  {
    return { technique };
  }
  std::vector<std::string> techniques;
  for (const int samples : lightSamples)
  {
    const bool isDefault = samples == ShadowSettings().lightSamples;
    techniques.push_back(
      technique + (isDefault ? "" : ":light_samples=" + std::to_string(samples)));
  }
  return techniques;
}

std::vector<Case> casesOf(const StudyPlan& plan)
{
  std::vector<Case> cases;
  for (const std::string& scene : plan.scenes)
  {
    ComparisonPlan comparison = plan.comparison;
    comparison.techniques = plan.hardTechniques;
    if (castsSoftShadows(plan.comparison, loadScene(scene)))
    {
      comparison.techniques.clear();
      for (const std::string& technique : plan.softTechniques)
      {
        for (const std::string& each : sampled(technique, plan.lightSamples))
        {
          comparison.techniques.push_back(each);
        }
      }
    }
    for (int view = 1; view <= plan.views; ++view)
    {
      cases.push_back({ scene + ", view " + std::to_string(view), scene, view, comparison });
    }
  }
  return cases;
}

/// Return a scene's camera, turned about its target: by 25 degrees to one side, to the other side,
/// by 50 degrees, and so on.
SceneCamera turnedTo(const SceneCamera& camera, int view)
{
  constexpr double stepDegrees = 25.0;
  const double degrees = stepDegrees * (view / 2) * (view % 2 == 0 ? 1.0 : -1.0);
  vtkNew<vtkTransform> turn;
  turn->Translate(camera.target.data());
  turn->RotateWXYZ(degrees, camera.up.data());
  turn->Translate(-camera.target[0], -camera.target[1], -camera.target[2]);
  SceneCamera turned = camera;
  turn->TransformPoint(camera.position.data(), turned.position.data());
  return turned;
}

Rows runCase(
  const Case& of, const std::function<void(double share, const std::string& step)>& progress)
{
  Scene scene = loadScene(of.scene);
  scene.name = of.scene;
  scene.camera = turnedTo(scene.camera, of.view);
  ComparisonEvents events;
  events.progress = progress;
  const VtkMessages messages;
  const ComparisonResults results = runComparison(scene, of.plan, events);
  if (!messages.errors().empty())
  {
    throw Failure(messages.errors().front());
  }
  Rows rows = rowsOf(results, of.view);
  for (Row& row : rows)
  {
    // Techniques take their usual route, so names need none.
    const std::string name = row["variant"];
    row["variant"] = std::regex_replace(name, std::regex(" (inline|image)$"), "");
  }
  return rows;
}

/// Return the rows of a case in its folder; none if it is missing, damaged or of other settings.
Rows finishedRows(const std::string& file, const Case& of)
{
  constexpr std::size_t largestBytes = 1 << 28;
  try
  {
    const nlohmann::ordered_json json =
      nlohmann::ordered_json::parse(readWholeFile(file, largestBytes));
    return json.at("how") == of.settings() ? json.at("rows").get<Rows>() : Rows();
  }
  catch (const nlohmann::ordered_json::exception&)
  {
    return {};
  }
  catch (const BadInput&)
  {
    return {};
  }
}

} // namespace

//------------------------------------------------------------------------------
Rows runStudy(const StudyPlan& plan, const std::string& folder,
  const std::function<void(double share, const std::string& step)>& progress)
{
  const std::vector<Case> cases = casesOf(plan);
  Rows rows;
  double done = 0.0;
  for (const Case& of : cases)
  {
    const std::filesystem::path caseFolder = std::filesystem::path(folder) / fileStem(of.name);
    const std::string file = (caseFolder / "rows.json").string();
    Rows ofCase = finishedRows(file, of);
    try
    {
      if (ofCase.empty())
      {
        ofCase = runCase(of,
          [&](double share, const std::string& step)
          { progress((done + share) / static_cast<double>(cases.size()), of.name + ", " + step); });
        std::filesystem::create_directories(caseFolder);
        const nlohmann::ordered_json json = { { "how", of.settings() }, { "rows", ofCase } };
        writeWholeFile(file, json.dump(2) + "\n");
      }
    }
    catch (const BadInput& error)
    {
      throw BadInput(of.name + ": " + error.what());
    }
    catch (const Failure& error)
    {
      throw Failure(of.name + ": " + error.what());
    }
    rows.insert(rows.end(), ofCase.begin(), ofCase.end());
    ++done;
  }
  return rows;
}

} // namespace gnomon::tool
