// Test if a scene may be split between tracers: compare the rays that a whole scene blocks with
// those that any of its parts blocks. Exit with an error if they differ by more than rounding.

#include "BenchmarkMain.h"
#include "Errors.h"
#include "Files.h"
#include "Progress.h"
#include "RandomScenes.h"
#include "Scene.h"
#include "VtkMessages.h"

#include "lights/LightSamples.h"
#include "plugin/scene/OccluderCollector.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <CLI/CLI.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <utility>
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
/// Shadow rays for each ray that is aimed at an edge.
constexpr std::size_t shadowRaysPerAimed = 10;
/// Shadow rays of which one may differ.
constexpr std::uint64_t raysPerDifference = 10000000;
/// Faults of a scene beyond which different rays are no longer judged: all count as faults.
constexpr std::uint64_t mostFaults = 100;
/// The margin, of either sign, below which rounding decides Embree's test.
constexpr double mostRoundings = 12.0;
/// A receiver's triangle in pixels, for shadowRayOffsetInside().
constexpr double pixelsAlong = 1024.0;
constexpr double infinite = std::numeric_limits<double>::infinity();

struct Options
{
  std::vector<std::string> scenes = { "bunny", "atrium", "terrain", "posts", "room",
    "flowers-side" };
  std::uint64_t rays = 10000000;
  unsigned int seed = 1;
  std::string table;
};

// Rays

/// A ray as the tracers get it, centred.
struct TestedRay
{
  glm::vec3 origin, direction;
  float rayFar; ///< in lengths of the direction
};

/// Rays of one length.
class RayList
{
public:
  explicit RayList(float rayFar)
    : rayFar_(rayFar)
  {
  }
  void add(const glm::vec3& origin, const glm::vec3& direction)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->origins_[axis].push_back(origin[axis]);
      this->directions_[axis].push_back(direction[axis]);
    }
  }
  std::size_t size() const { return this->origins_[0].size(); }
  TestedRay operator[](std::size_t i) const
  {
    const auto &o = this->origins_, &d = this->directions_;
    return { { o[0][i], o[1][i], o[2][i] }, { d[0][i], d[1][i], d[2][i] }, this->rayFar_ };
  }
  /// Test which rays are blocked.
  std::vector<std::uint8_t> blockedBy(const EmbreeTracer& tracer) const
  {
    const auto &o = this->origins_, &d = this->directions_;
    std::vector<std::uint8_t> blocked(this->size());
    tracer.areBlocked(this->size(), { o[0].data(), o[1].data(), o[2].data() },
      { d[0].data(), d[1].data(), d[2].data() }, this->rayFar_, blocked.data());
    return blocked;
  }

private:
  float rayFar_;
  std::vector<float> origins_[3], directions_[3];
};

/// Return any direction; one in four lies along an axis.
glm::dvec3 anyDirection(Random& random)
{
  glm::dvec3 axis(0.0);
  axis[static_cast<int>(random() % 3)] = random() % 2 ? 1.0 : -1.0;
  return random() % 4 ? unitVector(random) : axis;
}

/// Return a sun or a point light within the scene's box, with an area or none.
ShadowLight anyLight(const Occluders& occluders, Random& random)
{
  const Bounds& bounds = occluders.allCentred;
  const double size = std::pow(10.0, uniform(random, -3.0, -1.0));
  const bool isSun = random() % 2;
  const ShadowLight light = isSun ? directionalLight(anyDirection(random))
                                  : pointLight(occluders.frame.centre + bounds.centre() +
                                      0.5 * (bounds.upper - bounds.lower) * inCube(random));
  return random() % 2
    ? light
    : withArea(
        light, isSun ? diskArea(light.directionWorld, size) : ballArea(bounds.radius() * size));
}

/// Return a receiver at a random point of a random triangle.
PlacedReceiver anyReceiver(const Occluders& occluders, Random& random)
{
  const auto triangle = static_cast<std::uint32_t>(random() % occluders.triangles.size());
  const Surface& surface =
    *std::prev(std::upper_bound(occluders.surfaces.begin(), occluders.surfaces.end(), triangle,
      [](std::uint32_t of, const Surface& next) { return of < next.firstTriangle; }));
  const auto corners = centredCorners(occluders, surface, 0, triangle);
  const auto& [a, b, c] = corners;
  const glm::dvec3 areaVector = glm::cross(b - a, c - a);
  const double doubleArea = glm::length(areaVector); // > 0 in snapshots
  const glm::vec3 normal(areaVector / doubleArea);
  const double root = std::sqrt(uniform(random, 0.0, 1.0)), along = uniform(random, 0.0, 1.0);
  const double longest = std::max({ glm::length(b - a), glm::length(c - a), glm::length(c - b) });
  return { glm::vec3((1.0 - root) * a + root * (1.0 - along) * b + root * along * c),
    random() % 2 ? normal : -normal,
    shadowRayOffsetInside(noiseOf(occluders, surface, 0, triangle, corners, normal, doubleArea),
      static_cast<float>(longest / pixelsAlong)) };
}

/// Return shadow rays from random points of random triangles to a random light.
RayList shadowRays(const Occluders& occluders, std::size_t count, Random& random)
{
  const ShadowLight light = anyLight(occluders, random);
  const ShadowRayLight rayLight(light, occluders.frame.centre);
  const std::optional<LightSamples> samples =
    light.area ? std::optional<LightSamples>(light) : std::nullopt;
  return visitShadowRays(rayLight,
    [&](const auto& makeRay, float rayFar)
    {
      RayList rays(rayFar);
      while (rays.size() < count)
      {
        const auto [position, normal, offset] = anyReceiver(occluders, random);
        const ShadowRay ray = makeRay(position, normal, offset);
        if (ray.traced && samples)
        {
          const SamplePixel pixel = samples->pixel(random() & 1023u, random() & 1023u);
          const auto sample = static_cast<int>(random() % unsigned(samples->count()));
          rays.add(ray.origin,
            directionToSample(
              areaRays(rayLight, position, normal, ray.direction), samples->offset(sample, pixel)));
        }
        else if (ray.traced)
        {
          rays.add(ray.origin, ray.direction);
        }
      }
      return rays;
    });
}

/// Return rays that are aimed at corners, at middles of edges and at random points of edges. They
/// end just behind these points.
RayList raysAtEdges(const Occluders& occluders, std::size_t count, Random& random)
{
  RayList rays(shadowRayFarAtLight);
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::uvec3& corners = occluders.triangles[random() % occluders.triangles.size()];
    const auto first = static_cast<int>(random() % 3);
    const double places[] = { 0.0, 0.5, uniform(random, 0.0, 1.0) };
    const glm::dvec3 target = glm::mix(glm::dvec3(occluders.positionsCentred[corners[first]]),
      glm::dvec3(occluders.positionsCentred[corners[(first + 1) % 3]]), places[random() % 3]);
    const double distance =
      occluders.allCentred.radius() * std::pow(10.0, uniform(random, -3.0, 0.3));
    const glm::vec3 origin(target + distance * anyDirection(random));
    constexpr double past = 1.0 + 1.0 / 256.0;
    rays.add(origin, past * (target - glm::dvec3(origin)));
  }
  return rays;
}

// Margins

/// How far a ray is from the other answer, in roundings.
///
/// A triangle blocks a ray if the ray passes its three edges on their inner side, and meets its
/// plane between start and end. Each of these tests has a margin: its exact value over 2^-24 of the
/// lengths that it multiplies, negative if the ray fails it. A triangle's margin is the least one
/// of its tests, a scene's the largest one of its triangles. So a positive margin means that the
/// ray is blocked, and rounding can decide only where the margin is small.
struct RayMargin
{
  double roundings = -infinite; ///< the scene's
  /// The largest margin of the triangles whose least test is that of an edge. It is near 0 if the
  /// ray passes an edge that may decide its answer.
  double edgeRoundings = -infinite;
};

/// Return a test's value over the rounding of its terms; a value of 0 has no terms to divide by.
double inRoundings(double value, double terms)
{
  constexpr double roundoff = 5.9604644775390625e-8; // 2^-24
  return value == 0.0 ? 0.0 : value / (roundoff * terms);
}

/// Compute a ray's margin in double precision.
RayMargin marginOf(
  const Occluders& occluders, const std::vector<CastingTriangle>& triangles, const TestedRay& ray)
{
  const glm::dvec3 direction(ray.direction);
  const double length = glm::length(direction);
  RayMargin most;
  for (const CastingTriangle& triangle : triangles)
  {
    std::array<glm::dvec3, 3> v = triangle.corners; // from the ray's origin
    for (glm::dvec3& corner : v)
    {
      corner -= glm::dvec3(ray.origin);
    }
    const glm::dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
    const double along = glm::dot(normal, direction);
    if (occluders.surfaces[triangle.surface].oneSided && !(along > 0.0))
    {
      continue;
    }
    const double sign = along < 0.0 ? -1.0 : 1.0;
    double edges = infinite, longest = 0.0, farthest = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      // Embree multiplies edge, sum of corners and direction. It accepts negative values up to
      // 2^-23 of the three edges' sum, which is 2 |N.D|.
      const glm::dvec3 &from = v[i], &to = v[(i + 1) % 3];
      const double edge = glm::length(to - from);
      edges = std::min(edges,
        inRoundings(2.0 * sign * glm::dot(direction, glm::cross(from, to)),
          edge * glm::length(from + to) * length + 2.0 * std::abs(along)));
      longest = std::max(longest, edge);
      farthest = std::max(farthest, glm::length(from));
    }
    // The plane's distance is the volume of the three corners. Rounding them moves it by their
    // largest face.
    const double distance = sign * glm::dot(normal, v[0]), face = longest * farthest;
    double plane = inRoundings(distance, face * farthest);
    if (std::isfinite(ray.rayFar))
    {
      plane = std::min(plane,
        inRoundings(
          ray.rayFar * std::abs(along) - distance, face * (farthest + ray.rayFar * length)));
    }
    most.roundings = std::max(most.roundings, std::min(edges, plane));
    most.edgeRoundings = std::max(most.edgeRoundings, edges <= plane ? edges : -infinite);
  }
  return most;
}

// Splits

/// A scene, or a part of one, with its tracer.
struct TracedScene
{
  Occluders occluders;
  EmbreeTracer tracer; ///< shares the arrays of occluders
};

/// Return a scene of those triangles of `whole` for which isTaken(number) is true. Vertices,
/// surfaces and centre are the whole's.
template <typename IsTaken>
std::unique_ptr<TracedScene> makeTracedScene(const Occluders& whole, const IsTaken& isTaken)
{
  auto scene = std::make_unique<TracedScene>();
  Occluders& part = scene->occluders;
  part = whole;
  part.triangles.clear();
  part.positionsCentred.reserve(part.positionsCentred.size() + 1); // Embree reads beyond the last
  for (Surface& surface : part.surfaces)
  {
    const std::uint32_t first = surface.firstTriangle;
    surface.firstTriangle = static_cast<std::uint32_t>(part.triangles.size());
    for (std::uint32_t i = first; i < first + surface.triangleCount; ++i)
    {
      if (isTaken(i))
      {
        part.triangles.push_back(whole.triangles[i]);
      }
    }
    surface.triangleCount =
      static_cast<std::uint32_t>(part.triangles.size()) - surface.firstTriangle;
    surface.triangleOfDrawn.clear();
  }
  scene->tracer.update(part);
  return scene;
}

/// How a scene's triangles go to parts.
enum class SplitWay
{
  Scattered, ///< at random
  Blocks,    ///< runs of consecutive triangles
  Slabs      ///< by place along a random direction
};
constexpr int splitWays = 3;

/// Return the part that each triangle goes to.
std::vector<int> splitTriangles(const Occluders& whole, SplitWay way, int parts, Random& random)
{
  const glm::dvec3 direction = anyDirection(random);
  std::vector<std::pair<double, std::size_t>> order;
  for (const glm::uvec3& corners : whole.triangles)
  {
    const auto place = [&](std::uint32_t corner)
    { return glm::dot(direction, glm::dvec3(whole.positionsCentred[corner])); };
    const double key = way == SplitWay::Blocks ? 0.0
      : way == SplitWay::Scattered             ? uniform(random, 0.0, 1.0)
                                   : place(corners.x) + place(corners.y) + place(corners.z);
    order.emplace_back(key, order.size());
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> ends(static_cast<std::size_t>(parts), order.size());
  std::generate(ends.begin(), ends.end() - 1, [&] { return random() % (order.size() + 1); });
  std::sort(ends.begin(), ends.end());
  std::vector<int> partOf(order.size());
  for (std::size_t i = 0, part = 0; i < order.size(); ++i)
  {
    while (i >= ends[part])
    {
      ++part;
    }
    partOf[order[i].second] = static_cast<int>(part);
  }
  return partOf;
}

// The comparison

/// Rays of one kind, and those that the whole and its parts answer differently.
struct Comparison
{
  std::uint64_t rays = 0;
  std::uint64_t different = 0;
  std::uint64_t faults = 0;   ///< different or wrong, not at an edge within rounding
  double mostRoundings = 0.0; ///< largest margin of the different ones

  void add(const Comparison& other)
  {
    this->rays += other.rays;
    this->different += other.different;
    this->faults += other.faults;
    this->mostRoundings = std::max(this->mostRoundings, other.mostRoundings);
  }
};

/// One scene with its whole tracer.
class SceneStudy
{
public:
  /// @throws Failure if the margins of rays cannot be computed
  SceneStudy(std::string name, unsigned int seed)
    : name_(std::move(name))
    , seed_(seed)
  {
    this->collector_.collect(tool::makeRenderer(tool::loadScene(this->name_), 1.0));
    for (const Surface& surface : this->whole().surfaces)
    {
      if (surface.isInstanced() || surface.cutout)
      {
        throw tool::Failure(
          this->name_ + " has instances or cut-outs, which this program cannot judge");
      }
    }
    this->tracer_ = makeTracedScene(this->whole(), [](std::uint32_t) { return true; });
    this->triangles_ = castingTriangles(this->whole());
  }

  /// Split the scene and compare the answers to these rays.
  void compare(std::uint64_t rays)
  {
    Random random = this->randomOf(0);
    const auto way = static_cast<SplitWay>(this->splits_ % splitWays);
    const int count = leastParts + static_cast<int>(random() % (mostParts - leastParts + 1));
    const std::vector<int> partOf = splitTriangles(this->whole(), way, count, random);
    this->parts_.clear();
    for (int part = 0; part < count; ++part)
    {
      this->parts_.push_back(
        makeTracedScene(this->whole(), [&](std::uint32_t i) { return partOf[i] == part; }));
    }
    ++this->splits_;
    tbb::parallel_for(std::uint64_t(0), (rays + raysOfBatch - 1) / raysOfBatch,
      [&](std::uint64_t batch)
      {
        const std::size_t ofBatch =
          std::min<std::uint64_t>(raysOfBatch, rays - batch * raysOfBatch);
        Random ofRays = this->randomOf(1 + batch);
        const Comparison shadow = this->compare(shadowRays(this->whole(), ofBatch, ofRays));
        const Comparison aimed =
          this->compare(raysAtEdges(this->whole(), ofBatch / shadowRaysPerAimed, ofRays));
        const std::lock_guard<std::mutex> lock(this->mutex_);
        this->shadow_.add(shadow);
        this->aimed_.add(aimed);
      });
  }

  const Comparison& shadow() const { return this->shadow_; }
  const Comparison& aimed() const { return this->aimed_; }
  /// Return a line of CSV for each kind of rays.
  std::string rows() const
  {
    std::ostringstream rows;
    for (const auto& [kind, of] :
      { std::pair("shadow", this->shadow_), std::pair("aimed", this->aimed_) })
    {
      rows << this->name_ << "," << this->whole().triangles.size() << "," << this->splits_ << ","
           << kind << "," << of.rays << "," << of.different << ",";
      if (of.different > 0)
      {
        rows << std::fixed << std::setprecision(2) << of.mostRoundings;
      }
      rows << "\n";
    }
    return rows.str();
  }

private:
  const Occluders& whole() const { return this->collector_.occluders(); }

  /// Return random numbers that depend on nothing but the seed, the split and this number.
  Random randomOf(std::uint64_t number) const
  {
    std::seed_seq seeds{ this->seed_, static_cast<unsigned int>(this->splits_),
      static_cast<unsigned int>(number) };
    return Random(seeds);
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
    if (rays.size() > 0) // test the margin, and the whole's tracer: a clear margin is the answer
    {
      const RayMargin margin = marginOf(this->whole(), this->triangles_, rays[0]);
      const bool isClear = std::abs(margin.roundings) > mostRoundings;
      comparison.faults += isClear && (margin.roundings > 0.0) != (expected[0] != 0) ? 1 : 0;
    }
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      if (blocked[i] != expected[i])
      {
        this->judge(rays[i], comparison);
      }
    }
    return comparison;
  }

  void judge(const TestedRay& ray, Comparison& comparison)
  {
    ++comparison.different;
    double roundings = infinite;
    if (this->faults_ < mostFaults)
    {
      const RayMargin margin = marginOf(this->whole(), this->triangles_, ray);
      roundings = std::max(std::abs(margin.roundings), std::abs(margin.edgeRoundings));
      comparison.mostRoundings = std::max(comparison.mostRoundings, roundings);
    }
    if (roundings > mostRoundings)
    {
      ++comparison.faults;
      ++this->faults_;
    }
  }

  std::string name_;
  unsigned int seed_;
  OccluderCollector collector_;
  std::unique_ptr<TracedScene> tracer_;
  std::vector<CastingTriangle> triangles_;
  std::vector<std::unique_ptr<TracedScene>> parts_;
  std::uint64_t splits_ = 0;
  Comparison shadow_, aimed_;
  std::atomic<std::uint64_t> faults_{ 0 };
  std::mutex mutex_; ///< guards the comparisons
};

// The program

int run(int argc, char** argv)
{
  CLI::App app{ "Compares the shadow rays that a scene blocks with those that its parts block",
    "gnomon_benchmark_split" };
  Options options;
  tool::addNumber(app, "--rays", options.rays, std::uint64_t(1), std::uint64_t(1) << 40,
    "Shadow rays in all scenes together");
  tool::addTexts(app, "--scenes", options.scenes, "Scenes, separated by commas");
  app.add_option("--seed", options.seed, "Of splits and rays")->capture_default_str();
  app.add_option("-o,--output", options.table, "A table to write");
  CLI11_PARSE(app, argc, argv);
  if (!options.table.empty())
  {
    tool::requireWritableFile(options.table, "--output", { ".csv" });
  }

  const tool::VtkMessages messages;
  std::string table = "scene,triangles,splits,rays_are,rays,different,roundings\n";
  Comparison shadow, aimed;
  const std::uint64_t rays = std::max<std::uint64_t>(1, options.rays / options.scenes.size());
  for (const std::string& name : options.scenes)
  {
    tool::Progress progress(name + ": reading");
    SceneStudy scene(name, options.seed);
    // Two splits in each way, at least.
    const std::uint64_t splits =
      std::max<std::uint64_t>(2 * splitWays, (rays + raysOfSplit - 1) / raysOfSplit);
    for (std::uint64_t split = 0; split < splits; ++split)
    {
      progress.begin(
        name + ": split " + std::to_string(split + 1) + " of " + std::to_string(splits));
      scene.compare(rays * (split + 1) / splits - rays * split / splits);
    }
    shadow.add(scene.shadow());
    aimed.add(scene.aimed());
    table += scene.rows();
    std::cout << scene.rows() << std::flush;
  }
  if (!options.table.empty())
  {
    tool::writeWholeFile(options.table, table);
  }
  if (shadow.faults + aimed.faults > 0)
  {
    throw tool::Failure(std::to_string(shadow.faults + aimed.faults) +
      " rays differ or are wrong that do not pass an edge within rounding");
  }
  if (shadow.different > shadow.rays / raysPerDifference)
  {
    throw tool::Failure(std::to_string(shadow.different) + " of " + std::to_string(shadow.rays) +
      " shadow rays differ, more than 1 in " + std::to_string(raysPerDifference));
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
