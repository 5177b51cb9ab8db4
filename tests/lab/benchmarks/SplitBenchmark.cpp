// Test if a scene may be split between tracers: compare the rays that a whole scene blocks with
// those that any of its parts blocks. Exit with an error if they differ by more than rounding.

#include "BenchmarkMain.h"
#include "Errors.h"
#include "Files.h"
#include "Progress.h"
#include "Scene.h"
#include "SplitMargin.h"
#include "SplitRays.h"
#include "SplitScene.h"
#include "VtkMessages.h"

#include "plugin/scene/OccluderCollector.h"
#include "shadowtech/tracing/Embree.h"

#include <CLI/CLI.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <memory>
#include <mutex>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr int leastParts = 2;
constexpr int mostParts = 8;
/// Rays that one thread makes and traces.
constexpr std::size_t raysOfBatch = 4096;
/// Rays traced against one split.
constexpr std::uint64_t raysOfSplit = std::uint64_t(1) << 18;
/// Splits of a scene, at least: two in each way.
constexpr std::uint64_t leastSplits = 2 * splitWays;
/// Shadow rays for each ray that is aimed at an edge.
constexpr std::size_t shadowRaysPerAimed = 10;
/// Shadow rays of which one may differ.
constexpr std::uint64_t raysPerDifference = 10000000;
/// Faults of a scene beyond which different rays are no longer judged: all count as faults.
constexpr std::uint64_t mostFaults = 100;

struct Options
{
  std::vector<std::string> scenes = { "bunny", "atrium", "terrain", "posts", "room",
    "flowers-side" };
  std::uint64_t rays = 10000000;
  unsigned int seed = 1;
  std::string table;
};

/// Rays of one kind, and those that the whole and its parts answer differently.
struct Comparison
{
  std::uint64_t rays = 0;
  std::uint64_t blocked = 0; ///< by the whole
  std::uint64_t different = 0;
  std::uint64_t faults = 0;   ///< different or wrong, not at an edge within rounding
  std::uint64_t wrong = 0;    ///< of the faults, the whole's answer is not the exact one
  std::uint64_t atEnds = 0;   ///< of the faults, with a start or end in a triangle's plane
  double mostRoundings = 0.0; ///< largest margin of the different ones

  void add(const Comparison& other)
  {
    this->rays += other.rays;
    this->blocked += other.blocked;
    this->different += other.different;
    this->faults += other.faults;
    this->wrong += other.wrong;
    this->atEnds += other.atEnds;
    this->mostRoundings = std::max(this->mostRoundings, other.mostRoundings);
  }
};

struct SceneResult
{
  std::string name;
  std::size_t triangles = 0;
  std::uint64_t splits = 0;
  Comparison shadowRays;
  Comparison aimedRays;
};

/// @throws Failure if the margins of rays cannot be computed
void requireTriangles(const std::string& name, const Occluders& occluders)
{
  for (const Surface& surface : occluders.surfaces)
  {
    if (surface.isInstanced() || surface.cutout)
    {
      throw tool::Failure(name + " has instances or cut-outs, which this program cannot judge");
    }
  }
}

/// One scene with its whole tracer.
class SceneStudy
{
public:
  SceneStudy(const std::string& name, unsigned int seed)
    : seed_(seed)
  {
    this->result_.name = name;
    this->collector_.collect(tool::makeRenderer(tool::loadScene(name), 1.0));
    requireTriangles(name, this->whole());
    this->result_.triangles = this->whole().triangles.size();
    this->tracer_ = makeTracedScene(this->whole());
  }

  const SceneResult& result() const { return this->result_; }

  /// Split the scene and compare the answers to these rays.
  void compare(std::uint64_t rays)
  {
    std::mt19937 random = this->randomOf(0);
    const auto way = static_cast<SplitWay>(this->result_.splits % splitWays);
    const int count = std::uniform_int_distribution<int>(leastParts, mostParts)(random);
    this->parts_ = this->makeParts(splitTriangles(this->whole(), way, count, random), count);
    ++this->result_.splits;
    const std::uint64_t batches = (rays + raysOfBatch - 1) / raysOfBatch;
    tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, batches, 1),
      [&](const tbb::blocked_range<std::uint64_t>& range)
      {
        for (std::uint64_t batch = range.begin(); batch != range.end(); ++batch)
        {
          const std::size_t ofBatch =
            std::min<std::uint64_t>(raysOfBatch, rays - batch * raysOfBatch);
          std::mt19937 ofRays = this->randomOf(1 + batch);
          const Comparison shadowRays =
            this->compare(randomShadowRays(this->whole(), ofBatch, ofRays));
          const Comparison aimedRays =
            this->compare(raysAtEdges(this->whole(), ofBatch / shadowRaysPerAimed, ofRays));
          const std::lock_guard<std::mutex> lock(this->mutex_);
          this->result_.shadowRays.add(shadowRays);
          this->result_.aimedRays.add(aimedRays);
        }
      });
  }

private:
  const Occluders& whole() const { return this->collector_.occluders(); }

  /// Return random numbers that depend on nothing but the seed, the split and this number.
  std::mt19937 randomOf(std::uint64_t number) const
  {
    std::seed_seq seeds{ this->seed_, static_cast<unsigned int>(this->result_.splits),
      static_cast<unsigned int>(number) };
    return std::mt19937(seeds);
  }

  std::vector<std::unique_ptr<TracedScene>> makeParts(
    const std::vector<int>& partOf, int count) const
  {
    std::vector<std::unique_ptr<TracedScene>> parts;
    for (int part = 0; part < count; ++part)
    {
      std::vector<bool> isTaken(partOf.size());
      std::transform(
        partOf.begin(), partOf.end(), isTaken.begin(), [&](int of) { return of == part; });
      parts.push_back(makeTracedScene(this->whole(), isTaken));
    }
    return parts;
  }

  Comparison compare(const RayList& rays)
  {
    const std::vector<std::uint8_t> expected = rays.blockedBy(this->tracer_->tracer);
    std::vector<std::uint8_t> blocked(rays.size());
    for (const auto& part : this->parts_)
    {
      const std::vector<std::uint8_t> byPart = rays.blockedBy(part->tracer);
      std::transform(byPart.begin(), byPart.end(), blocked.begin(), blocked.begin(),
        [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
    }
    Comparison comparison;
    comparison.rays = rays.size();
    if (rays.size() > 0)
    {
      this->checkMargin(rays[0], expected[0] != 0, comparison);
    }
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      comparison.blocked += expected[i];
      if (blocked[i] != expected[i])
      {
        this->judge(rays[i], comparison);
      }
    }
    return comparison;
  }

  /// Test the margin, and the whole's tracer: a clear margin tells the answer.
  void checkMargin(const TestedRay& ray, bool blocked, Comparison& comparison)
  {
    const RayMargin margin = marginOf(this->whole(), ray);
    if (std::abs(margin.roundings) > mostRoundings && (margin.roundings > 0.0) != blocked)
    {
      ++comparison.faults;
      ++comparison.wrong;
    }
  }

  void judge(const TestedRay& ray, Comparison& comparison)
  {
    ++comparison.different;
    if (this->faults_ >= mostFaults)
    {
      ++comparison.faults;
      return;
    }
    const RayMargin margin = marginOf(this->whole(), ray);
    const double roundings = std::max(std::abs(margin.roundings), std::abs(margin.edgeRoundings));
    comparison.mostRoundings = std::max(comparison.mostRoundings, roundings);
    if (roundings > mostRoundings)
    {
      ++comparison.faults;
      ++this->faults_;
      comparison.atEnds += std::abs(margin.roundings) <= mostRoundings ? 1 : 0;
    }
  }

  unsigned int seed_;
  OccluderCollector collector_;
  std::unique_ptr<TracedScene> tracer_;
  std::vector<std::unique_ptr<TracedScene>> parts_;
  SceneResult result_;
  std::atomic<std::uint64_t> faults_{ 0 };
  std::mutex mutex_; ///< guards result_'s comparisons
};

//------------------------------------------------------------------------------
// The table

/// Return the numbers that are not in the table.
std::string textOf(const Comparison& comparison)
{
  return std::to_string(comparison.blocked) + " blocked, " + std::to_string(comparison.faults) +
    " faults (" + std::to_string(comparison.atEnds) + " at a start or end, " +
    std::to_string(comparison.wrong) + " wrong)";
}

/// Return a line of CSV for each kind of rays.
std::string rowsOf(const SceneResult& result)
{
  std::ostringstream rows;
  for (const auto& [kind, of] :
    { std::pair("shadow", result.shadowRays), std::pair("aimed", result.aimedRays) })
  {
    rows << result.name << "," << result.triangles << "," << result.splits << "," << kind << ","
         << of.rays << "," << of.different << ",";
    if (of.different > 0)
    {
      rows << std::fixed << std::setprecision(2) << of.mostRoundings;
    }
    rows << "\n";
  }
  return rows.str();
}

SceneResult sumOf(const std::vector<SceneResult>& results)
{
  SceneResult sum;
  sum.name = "all";
  for (const SceneResult& result : results)
  {
    sum.splits += result.splits;
    sum.shadowRays.add(result.shadowRays);
    sum.aimedRays.add(result.aimedRays);
  }
  return sum;
}

/// Return why the results refute exactness; empty if they do not.
std::string faultOf(const SceneResult& sum)
{
  const std::uint64_t faults = sum.shadowRays.faults + sum.aimedRays.faults;
  if (faults > 0)
  {
    return std::to_string(faults) +
      " rays differ or are wrong that do not pass an edge within rounding";
  }
  return sum.shadowRays.different > sum.shadowRays.rays / raysPerDifference
    ? std::to_string(sum.shadowRays.different) + " of " + std::to_string(sum.shadowRays.rays) +
      " shadow rays differ, more than 1 in " + std::to_string(raysPerDifference)
    : std::string();
}

//------------------------------------------------------------------------------
// The program

/// Compare this many shadow rays, in splits of equal size.
SceneResult study(const std::string& name, const Options& options, std::uint64_t rays)
{
  tool::Progress progress(name + ": reading");
  SceneStudy scene(name, options.seed);
  const std::uint64_t splits = std::max(leastSplits, (rays + raysOfSplit - 1) / raysOfSplit);
  for (std::uint64_t split = 0; split < splits; ++split)
  {
    progress.begin(name + ": split " + std::to_string(split + 1) + " of " + std::to_string(splits));
    scene.compare(rays * (split + 1) / splits - rays * split / splits);
  }
  return scene.result();
}

int run(int argc, char** argv)
{
  CLI::App app{ "Compares the shadow rays that a scene blocks with those that its parts block",
    "gnomon_benchmark_split" };
  Options options;
  app.add_option("--rays", options.rays, "Shadow rays in all scenes together")
    ->check(CLI::Range(std::uint64_t(1), std::uint64_t(1) << 40))
    ->capture_default_str();
  app.add_option("--scenes", options.scenes, "Scenes, separated by commas")
    ->delimiter(',')
    ->capture_default_str();
  app.add_option("--seed", options.seed, "Of splits and rays")->capture_default_str();
  app.add_option("-o,--output", options.table, "A table to write");
  CLI11_PARSE(app, argc, argv);
  if (!options.table.empty())
  {
    tool::requireWritableFile(options.table, "--output", { ".csv" });
  }

  const tool::VtkMessages messages;
  std::vector<SceneResult> results;
  const std::uint64_t count = options.scenes.size();
  for (std::uint64_t i = 0; i < count; ++i)
  {
    results.push_back(
      study(options.scenes[i], options, options.rays * (i + 1) / count - options.rays * i / count));
    const SceneResult& last = results.back();
    std::cout << rowsOf(last) << "  shadow rays: " << textOf(last.shadowRays)
              << "\n  aimed rays: " << textOf(last.aimedRays) << std::endl;
  }
  if (!options.table.empty())
  {
    std::string table = "scene,triangles,splits,rays_are,rays,different,roundings\n";
    for (const SceneResult& result : results)
    {
      table += rowsOf(result);
    }
    tool::writeWholeFile(options.table, table);
  }
  const std::string fault = faultOf(sumOf(results));
  if (!fault.empty())
  {
    throw tool::Failure(fault);
  }
  return 0;
}

} // namespace
} // namespace gnomon::test

int main(int argc, char** argv)
{
  return gnomon::tool::runBenchmark(
    "gnomon_benchmark_split", [&] { return gnomon::test::run(argc, argv); });
}
