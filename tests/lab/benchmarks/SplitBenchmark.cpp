// Test if a scene may be split between tracers: compare the rays that a whole scene blocks with
// those that any of its parts blocks. Exit with an error if they differ by more than rounding.

#include "BenchmarkMain.h"
#include "Errors.h"
#include "Files.h"
#include "Machine.h"
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
  std::string markdown;
};

/// Rays of one kind, and those that the whole and its parts answer differently.
struct Comparison
{
  std::uint64_t rays = 0;
  std::uint64_t blocked = 0; ///< by the whole
  std::uint64_t different = 0;
  std::uint64_t onlyWhole = 0; ///< of the different ones, blocked by the whole and by no part
  std::uint64_t exact = 0;     ///< of the different ones, through a point of an edge
  std::uint64_t faults = 0;    ///< different or wrong, not at an edge within rounding
  std::uint64_t wrong = 0;     ///< of the faults, the whole's answer is not the exact one
  std::uint64_t atEnds = 0;    ///< of the faults, with a start or end in a triangle's plane
  double mostRoundings = 0.0;  ///< largest margin of the different ones

  void add(const Comparison& other)
  {
    this->rays += other.rays;
    this->blocked += other.blocked;
    this->different += other.different;
    this->onlyWhole += other.onlyWhole;
    this->exact += other.exact;
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
        comparison.onlyWhole += expected[i];
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
    comparison.exact += roundings == 0.0 ? 1 : 0;
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
// The page

/// Return a number with separators: "1,000,000".
std::string grouped(std::uint64_t number)
{
  std::string text = std::to_string(number);
  for (int end = static_cast<int>(text.size()) - 3; end > 0; end -= 3)
  {
    text.insert(static_cast<std::size_t>(end), ",");
  }
  return text;
}

/// Return the cells of one kind of rays: their number, the different ones, their largest margin.
std::string cellsOf(const Comparison& comparison)
{
  std::ostringstream text;
  text << " " << grouped(comparison.rays) << " | " << grouped(comparison.different) << " | ";
  if (comparison.different > 0)
  {
    text << std::fixed << std::setprecision(2) << comparison.mostRoundings;
  }
  return text.str() + " |";
}

/// Return the numbers that are not on the page.
std::string textOf(const Comparison& comparison)
{
  return std::to_string(comparison.blocked) + " blocked, " + std::to_string(comparison.faults) +
    " faults (" + std::to_string(comparison.atEnds) + " at a start or end, " +
    std::to_string(comparison.wrong) + " wrong)";
}

std::string rowOf(const SceneResult& result)
{
  return "| " + result.name + " | " +
    (result.triangles > 0 ? grouped(result.triangles) : std::string()) + " | " +
    grouped(result.splits) + " |" + cellsOf(result.shadowRays) + cellsOf(result.aimedRays) + "\n";
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
    return grouped(faults) + " rays differ or are wrong that do not pass an edge within rounding";
  }
  return sum.shadowRays.different > sum.shadowRays.rays / raysPerDifference
    ? grouped(sum.shadowRays.different) + " of " + grouped(sum.shadowRays.rays) +
      " shadow rays differ, more than 1 in " + grouped(raysPerDifference)
    : std::string();
}

std::string pageOf(const std::vector<SceneResult>& results, const std::string& command)
{
  const SceneResult sum = sumOf(results);
  const Comparison& aimed = sum.aimedRays;
  const std::string fault = faultOf(sum);
  std::ostringstream page;
  page << "# Shadow rays against a split scene\n\n"
       << (fault.empty()
              ? std::string("A scene may be split between tracers: its parts together block the "
                            "rays that the whole blocks,\nexcept for rays that pass an edge "
                            "within rounding.\n")
              : "A scene may not be split between tracers: " + fault + ".\n")
       << "Of " << grouped(sum.shadowRays.rays) << " shadow rays, "
       << grouped(sum.shadowRays.different) << " have different answers.\n\n`" << command
       << "`\nmeasures this and writes this page.\n\n"
       << "| scene | triangles | splits | shadow rays | different | roundings | aimed rays | "
          "different | roundings |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const SceneResult& result : results)
  {
    page << rowOf(result);
  }
  page
    << rowOf(sum) << "\n"
    << "- **Splits** have " << leastParts << " to " << mostParts
    << " parts, each with an Embree scene of its own. Triangles go to parts at\n  random, in runs "
       "of their order, or in slabs. All parts have the whole's vertices, bit for bit.\n"
    << "- **Shadow rays** start at random points of random triangles, as receivers do. They go "
       "to suns,\n  point lights and points of area lights.\n"
    << "- **Aimed rays** go to corners, to middles of edges and to random points of edges. They "
       "end just\n  behind these points. One in four goes along an axis.\n"
    << "- **Roundings** is the largest distance of a different ray from an edge that may decide "
       "it. The unit\n  is 2^-24 of the lengths that the edge's test multiplies. Rounding may "
       "decide up to "
    << mostRoundings << " of them\n  (`tests/lab/benchmarks/SplitMargin.h`).\n\n"
    << "Of the different aimed rays, " << grouped(aimed.onlyWhole)
    << " are blocked by the whole alone and " << grouped(aimed.different - aimed.onlyWhole)
    << " by parts alone.\n"
    << grouped(aimed.exact) << " of them meet an edge exactly.\n\n"
    << "The test `SplitBenchmarkRuns` repeats this with fewer rays. It fails if a ray differs "
       "elsewhere, or\nif more than one shadow ray in "
    << grouped(raysPerDifference) << " differs.\n\nMeasured on: " << tool::processorName()
    << "; Embree " << RTC_VERSION_STRING << ".\n";
  return page.str();
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
  app.add_option("--markdown", options.markdown, "Page to write");
  CLI11_PARSE(app, argc, argv);
  if (!options.markdown.empty())
  {
    tool::requireWritableFile(options.markdown, "--markdown", { ".md" });
  }

  const tool::VtkMessages messages;
  std::vector<SceneResult> results;
  const std::uint64_t count = options.scenes.size();
  for (std::uint64_t i = 0; i < count; ++i)
  {
    results.push_back(
      study(options.scenes[i], options, options.rays * (i + 1) / count - options.rays * i / count));
    const SceneResult& last = results.back();
    std::cout << rowOf(last) << "  shadow rays: " << textOf(last.shadowRays)
              << "\n  aimed rays: " << textOf(last.aimedRays) << std::endl;
  }
  if (!options.markdown.empty())
  {
    tool::writeWholeFile(options.markdown, pageOf(results, tool::commandOf(argc, argv)));
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
