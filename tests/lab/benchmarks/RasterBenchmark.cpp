// Measure conservative maps: whole maps, from the snapshot to the pixels' queries. Also measure
// finding the casters' edges, and updating them after all casters have moved.

#include "BenchmarkMain.h"
#include "FrameVariant.h"
#include "Scene.h"
#include "SyntheticScene.h"
#include "Timing.h"

#include "lights/LightViews.h"
#include "plugin/scene/OccluderCollector.h"
#include "shadowtech/exact/ConservativeMap.h"

#include <CLI/CLI.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

struct Options
{
  std::vector<std::string> scenes{ "bunny", "atrium", "terrain" };
  std::vector<int> mapSizes{ 512, 1024, 2048 };
  int repetitions = 21;
};

/// A scene's casters and its sun.
class Subject
{
public:
  explicit Subject(const std::string& name)
  {
    const tool::Scene scene = tool::loadScene(name);
    this->collector_.collect(tool::makeRenderer(scene, 1.0));
    this->edges_.update(this->occluders());
    const tool::SceneLight& sun = scene.lights.at(0);
    this->light_ = directionalLight({ sun.target[0] - sun.position[0],
      sun.target[1] - sun.position[1], sun.target[2] - sun.position[2] });
  }

  const Occluders& occluders() const { return this->collector_.occluders(); }
  const CasterEdges& edges() const { return this->edges_; }
  /// The sun's view of all casters.
  LightView view(int sizeTexels) const
  {
    ViewFitting fitting;
    fitting.centreWorld = this->occluders().frame.centre;
    fitting.castersCentred = this->occluders().castersCentred;
    fitting.receiversCentred = this->occluders().allCentred;
    fitting.texels.side = sizeTexels;
    return fitLightViews(this->light_, fitting).views.at(0);
  }

private:
  OccluderCollector collector_;
  CasterEdges edges_;
  ShadowLight light_;
};

/// Return the same casters, all of them turned.
Occluders turned(Occluders occluders)
{
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 1.0, glm::dvec3(1.0, 2.0, 3.0)));
  for (glm::vec3& position : occluders.positionsCentred)
  {
    position = turn * glm::dvec3(position);
  }
  // Later than any version in the snapshot.
  constexpr std::uint64_t later = 1u << 30;
  occluders.positionsVersion += later;
  for (Surface& surface : occluders.surfaces)
  {
    surface.positionsVersion += later;
  }
  return occluders;
}

void runEdges(const Subject& subject, const std::string& name, int repetitions)
{
  const Occluders moved = turned(subject.occluders());
  CasterEdges kept;
  bool isMoved = false;
  std::vector<Way> ways;
  ways.push_back({ "found", [&] { CasterEdges().update(subject.occluders()); } });
  ways.push_back({ "moved",
    [&]
    {
      kept.update(isMoved ? subject.occluders() : moved);
      isMoved = !isMoved;
    } });
  takeTurns(ways, repetitions);
  std::cout << name << ", edges, seams and parts\n";
  printTimes(ways, ways.front().name);
}

void runMaps(const Subject& subject, const std::string& name, int sizeTexels, int repetitions)
{
  const LightView view = subject.view(sizeTexels);
  std::vector<Way> ways;
  const auto add = [&](const std::string& technique, Covering covering)
  {
    ways.push_back({ technique, [&view, &subject, sizeTexels, rule = certainRule(covering)] {
                      rule(view, false, sizeTexels, subject.occluders(), subject.edges());
                    } });
  };
  add("crsm", Covering::Triangle);
  add("crsma", Covering::Ring);
  add("silhouette", Covering::Silhouette);
  takeTurns(ways, repetitions);
  std::cout << name << ", " << CasterPlacements(subject.occluders()).triangleCount()
            << " triangles, map " << sizeTexels << "\n";
  printTimes(ways, ways.front().name);
}

int runAll(int argc, char** argv)
{
  CLI::App app{ "Times conservative maps, and how casters' edges are found",
    "gnomon_benchmark_raster" };
  Options options;
  app.add_option("SCENES", options.scenes, "Scenes, as for gnomon, with a sun")
    ->capture_default_str();
  app.add_option("--map-sizes", options.mapSizes, "Sides of the maps in texels")
    ->check(CLI::Range(16, 16384))
    ->delimiter(',')
    ->capture_default_str();
  app.add_option("--repetitions", options.repetitions, "Timed maps of each")
    ->check(CLI::Range(1, 10000))
    ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::cout << tool::processorName() << "; medians of " << options.repetitions << "\n";
  for (const std::string& name : options.scenes)
  {
    const Subject subject(name);
    runEdges(subject, name, options.repetitions);
    for (const int size : options.mapSizes)
    {
      runMaps(subject, name, size, options.repetitions);
    }
  }
  return 0;
}

} // namespace
} // namespace gnomon::test

int main(int argc, char** argv)
{
  return gnomon::tool::runBenchmark(
    "gnomon_benchmark_raster", [&] { return gnomon::test::runAll(argc, argv); });
}
