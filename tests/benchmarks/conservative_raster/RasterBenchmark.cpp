// What it costs to draw the triangles of a conservative map by OpenGL and to read them back, beside the rasteriser
// of `crsm` on the processor: all take turns.

#include "BenchmarkMain.h"
#include "FrameTiming.h"
#include "GpuRaster.h"
#include "Machine.h"
#include "Scene.h"
#include "SyntheticScene.h"

#include "plugin/OccluderCollector.h"
#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/conservative/CasterBands.h"
#include "shadowtech/conservative/CasterEdges.h"
#include "shadowtech/conservative/ConservativeMap.h"
#include "shadowtech/conservative/TexelCells.h"

#include <CLI/CLI.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <vtkNew.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
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
  /// The sun's view of them all.
  LightView view(int sizeTexels) const
  {
    ViewFitting fitting;
    fitting.centreWorld = this->occluders().centreWorld;
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

/// The share of `crsm`'s drawing that is triangles alone: looked at once to find their bands and the margin, then
/// drawn, band by band.
class ProcessorsTriangles
{
public:
  ProcessorsTriangles(const CasterScene& scene, int sizeTexels)
    : scene_(scene)
    , size_(sizeTexels)
  {
  }

  void draw(std::vector<TexelDepths>& texels)
  {
    const CasterPlacements placements(this->scene_.occluders);
    CasterBands bands(this->size_);
    tbb::enumerable_thread_specific<double> margins(0.0);
    placements.visitTriangles(
      [&](std::uint32_t number, std::uint32_t triangle)
      {
        const MapPolygon polygon = this->polygon(placements[number], placements, triangle);
        if (polygon.role.present)
        {
          const auto [low, high] = polygon.rows();
          bands.add(low - largestMargin, high + largestMargin, { number, triangle });
          margins.local() = std::max(margins.local(), polygon.role.poison ? 0.0 : polygon.margin);
        }
      });
    this->margin_ = margins.combine([](double a, double b) { return std::max(a, b); });
    texels.resize(static_cast<std::size_t>(this->size_) * static_cast<std::size_t>(this->size_));
    drawBands<Cell>(
      this->size_,
      [&](int band, Span rows, Cell* cells)
      {
        bands.visit(band,
          [&](const BandItem& item)
          {
            drawPolygon(this->polygon(placements[item.placement], placements, item.index),
              this->margin_, this->size_, rows, cells);
          });
      },
      [&](std::size_t i, const Cell& cell) {
        texels[i] = { cell.nearest, cell.contained };
      });
  }

  /// Of all texels, as of the last time.
  double marginTexels() const { return this->margin_; }

private:
  MapPolygon polygon(
    const Placement& placement, const CasterPlacements& placements, std::uint32_t triangle) const
  {
    return polygonOf(this->scene_, placements.surfaceOf(placement), placement.instance, triangle);
  }

  const CasterScene& scene_;
  int size_;
  double margin_ = 0.0;
};

/// Sends all casting triangles to where they are drawn.
/// @return how many there are
std::size_t send(const Occluders& occluders, GpuRaster& raster)
{
  const CasterPlacements placements(occluders);
  std::vector<glm::vec3> positionsCentred(3 * placements.triangleCount());
  std::vector<glm::uvec3> triangles(placements.triangleCount());
  placements.visitTriangles(
    [&](std::uint32_t number, std::uint32_t triangle)
    {
      const Placement& placement = placements[number];
      const std::size_t i = placements.numberOf(placement, triangle);
      const auto corners =
        centredCorners(occluders, placements.surfaceOf(placement), placement.instance, triangle);
      const auto first = static_cast<std::uint32_t>(3 * i);
      triangles[i] = { first, first + 1, first + 2 };
      std::copy(corners.begin(), corners.end(), &positionsCentred[first]);
    });
  raster.send(positionsCentred, triangles);
  return triangles.size();
}

/// In milliseconds.
struct Time
{
  double wall;
  double
    processor; ///< of all threads: tells more than wall clock on a machine that is not alone, where OpenGL is software
};

Time now()
{
  const auto millisecondsOf = [](clockid_t clock)
  {
    timespec time;
    clock_gettime(clock, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  };
  return { millisecondsOf(CLOCK_MONOTONIC), millisecondsOf(CLOCK_PROCESS_CPUTIME_ID) };
}

/// One way to draw a map.
struct Way
{
  std::string name;
  std::function<void()> draw;
  std::vector<double> wall = {};
  std::vector<double> processor = {};

  Time medians() const { return { tool::median(this->wall), tool::median(this->processor) }; }
};

/// The share of texels in which something is, in per cent.
double percentBelow(const std::vector<TexelDepths>& texels, float TexelDepths::*depth)
{
  const auto count = std::count_if(texels.begin(), texels.end(),
    [&](const TexelDepths& texel)
    { return texel.*depth < std::numeric_limits<float>::infinity(); });
  return 100.0 * static_cast<double>(count) / static_cast<double>(texels.size());
}

void run(const Subject& subject, const std::string& name, int sizeTexels, int repetitions)
{
  const LightView view = subject.view(sizeTexels);
  const CasterScene scene = casterScene(view, false, sizeTexels, subject.occluders());
  const glm::dmat4 mapFromCentred = scene.space.mapFromCentred();

  std::vector<Way> ways;
  std::vector<std::vector<TexelDepths>> drawn(2 + allRasterPaths().size());
  ways.push_back({ "crsm, all of its map",
    [&]
    {
      certainRule(Covering::Triangle)(
        view, false, sizeTexels, subject.occluders(), subject.edges());
    } });
  ProcessorsTriangles processor(scene, sizeTexels);
  ways.push_back({ "its triangles alone", [&] { processor.draw(drawn[1]); } });
  std::vector<std::unique_ptr<GpuRaster>> rasters;
  std::size_t triangles = 0;
  for (const RasterPath path : allRasterPaths())
  {
    const std::string why = whyUnsupported(path);
    if (!why.empty())
    {
      std::cout << nameOf(path) << ": not measured, " << why << "\n";
      continue;
    }
    rasters.push_back(std::make_unique<GpuRaster>(path));
    triangles = send(subject.occluders(), *rasters.back());
    ways.push_back({ nameOf(path),
      [&, raster = rasters.back().get(), texels = &drawn[ways.size()]]
      { raster->draw(mapFromCentred, sizeTexels, processor.marginTexels(), *texels); } });
  }

  for (int repetition = 0; repetition <= repetitions; ++repetition)
  {
    for (Way& way : ways)
    {
      const Time begin = now();
      way.draw();
      const Time end = now();
      if (repetition > 0) // the first one builds programs
      {
        way.wall.push_back(end.wall - begin.wall);
        way.processor.push_back(end.processor - begin.processor);
      }
    }
  }
  std::cout << name << ", " << triangles << " triangles, map " << sizeTexels << "\n"
            << std::setw(36) << "ms" << std::setw(10) << "x crsm" << std::setw(16) << "processor ms"
            << std::setw(10) << "x crsm" << std::setw(12) << "touched %" << std::setw(13)
            << "contained %\n";
  const Time whole = ways.front().medians();
  for (std::size_t i = 0; i < ways.size(); ++i)
  {
    const Time time = ways[i].medians();
    std::cout << "  " << std::left << std::setw(24) << ways[i].name << std::right
              << std::setprecision(2) << std::setw(10) << time.wall << std::setw(10)
              << time.wall / whole.wall << std::setw(16) << time.processor << std::setw(10)
              << time.processor / whole.processor;
    if (!drawn[i].empty())
    {
      std::cout << std::setprecision(3) << std::setw(12)
                << percentBelow(drawn[i], &TexelDepths::nearest) << std::setw(12)
                << percentBelow(drawn[i], &TexelDepths::contained);
    }
    std::cout << "\n";
  }
  std::cout << std::flush;
}

int runAll(int argc, char** argv)
{
  CLI::App app{ "Times conservative maps drawn by OpenGL and by the processor, taking turns",
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

  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->Initialize();
  window->MakeCurrent();
  std::cout << tool::openGlName(window) << "; " << tool::processorName() << "; medians of "
            << options.repetitions << "\n"
            << std::fixed;
  for (const std::string& name : options.scenes)
  {
    const Subject subject(name);
    for (const int size : options.mapSizes)
    {
      run(subject, name, size, options.repetitions);
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
