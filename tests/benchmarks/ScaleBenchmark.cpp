// What large scenes cost: time per stage, counters and memory, frame by frame, of one large
// surface, of many props, or of many blocks of one prop. At rest, with one prop moved, and with all
// vertices moved, as in a time series.

#include "BenchmarkMain.h"
#include "Errors.h"
#include "VtkMessages.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/base/FrameReport.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkLight.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace gnomon::tool
{
namespace
{

struct Options
{
  int triangles = 1000000;
  int props = 1;
  int blocks = 0;
  std::string technique = "nsm";
  int sidePixels = 512;
  int frames = 3;
};

/// How high the hills are at a place, at a time: a wave of hills that travels along x.
double height(double x, double y, double time)
{
  return 0.03 * std::sin(40.0 * x + time) * std::cos(31.0 * y);
}

void moveHills(vtkPoints* points, double time)
{
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double place[3];
    points->GetPoint(i, place);
    points->SetPoint(i, place[0], place[1], height(place[0], place[1], time));
  }
  points->Modified();
}

/// A hilly square of the given number of triangles or a few more, with its corner at (x, y).
vtkSmartPointer<vtkPolyData> makeTerrain(int triangles, double x, double y, double side)
{
  const int cells = std::max(1, static_cast<int>(std::ceil(std::sqrt(triangles / 2.0))));
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(cells + 1) * (cells + 1));
  const double step = side / cells;
  vtkIdType point = 0;
  for (int row = 0; row <= cells; ++row)
  {
    for (int column = 0; column <= cells; ++column)
    {
      const double px = x + column * step;
      const double py = y + row * step;
      points->SetPoint(point++, px, py, height(px, py, 0.0));
    }
  }
  vtkNew<vtkCellArray> polygons;
  polygons->AllocateExact(
    2 * static_cast<vtkIdType>(cells) * cells, 6 * static_cast<vtkIdType>(cells) * cells);
  for (int row = 0; row < cells; ++row)
  {
    for (int column = 0; column < cells; ++column)
    {
      const vtkIdType corner = static_cast<vtkIdType>(row) * (cells + 1) + column;
      polygons->InsertNextCell({ corner, corner + 1, corner + cells + 2 });
      polygons->InsertNextCell({ corner, corner + cells + 2, corner + cells + 1 });
    }
  }
  const auto terrain = vtkSmartPointer<vtkPolyData>::New();
  terrain->SetPoints(points);
  terrain->SetPolys(polygons);
  return terrain;
}

/// A value in kilobytes from /proc/self/status, in megabytes.
double processMegabytes(const std::string& name)
{
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;)
  {
    if (word == name + ":")
    {
      double kilobytes = 0.0;
      file >> kilobytes;
      return 1.024e-3 * kilobytes;
    }
  }
  return 0.0;
}

double medianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

/// From here on, the peak counts anew.
void resetPeak()
{
  std::ofstream("/proc/self/clear_refs") << 5;
}

class Benchmark
{
public:
  explicit Benchmark(const Options& options)
  {
    const int perSide =
      static_cast<int>(std::ceil(std::sqrt(std::max(options.props, options.blocks))));
    const double side = 1.0 / perSide;
    const auto place = [&](int i)
    {
      auto terrain = makeTerrain(options.triangles / std::max({ options.props, options.blocks, 1 }),
        i % perSide * side, i / perSide * side, 0.8 * side);
      this->points_.emplace_back(terrain->GetPoints());
      return terrain;
    };
    if (options.blocks > 0)
    {
      vtkNew<vtkMultiBlockDataSet> data;
      for (int i = 0; i < options.blocks; ++i)
      {
        data->SetBlock(static_cast<unsigned int>(i), place(i));
      }
      vtkNew<vtkCompositePolyDataMapper2> mapper;
      mapper->SetInputDataObject(data);
      this->add(mapper);
    }
    else
    {
      for (int i = 0; i < options.props; ++i)
      {
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(place(i));
        this->add(mapper);
      }
    }
    vtkNew<vtkLight> sun;
    sun->SetPosition(0.4, 0.3, 0.3);
    sun->SetFocalPoint(0.0, 0.0, 0.0);
    this->renderer_->AddLight(sun);
    this->renderer_->GetActiveCamera()->SetPosition(0.5, -0.9, 0.8);
    this->renderer_->GetActiveCamera()->SetFocalPoint(0.5, 0.45, 0.0);
    this->renderer_->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
    this->renderer_->ResetCameraClippingRange();
    this->window_->SetSize(options.sidePixels, options.sidePixels);
    this->window_->SetMultiSamples(0);
    this->window_->AddRenderer(this->renderer_);
    this->pass_->SetTechnique(options.technique.c_str());
    this->pass_->SetMeasureStages(true);
  }

  void run(int frames)
  {
    this->frame("plain VTK", nullptr, [] {});
    this->frame("first frame with the pass", this->pass_, [] {});
    for (int i = 0; i < frames; ++i)
    {
      this->frame("nothing changed", this->pass_, [] {});
    }
    for (int i = 1; i <= frames; ++i)
    {
      this->frame(
        "one prop moved", this->pass_, [&] { this->moved_->SetPosition(0.0, 0.0, 1e-3 * i); });
    }
    std::vector<double> plain;
    std::vector<double> shadowed;
    for (int i = 1; i <= frames; ++i)
    {
      plain.push_back(this->frame(
        "plain VTK, all vertices moved", nullptr, [&] { this->moveAllVertices(0.2 * i - 0.1); }));
      shadowed.push_back(
        this->frame("all vertices moved", this->pass_, [&] { this->moveAllVertices(0.2 * i); }));
    }
    std::cout << "all vertices moved: " << medianOf(shadowed) / medianOf(plain)
              << " times plain VTK, medians of " << frames << " frames by turns\n";
  }

private:
  void moveAllVertices(double time)
  {
    for (vtkPoints* points : this->points_)
    {
      moveHills(points, time);
    }
  }

  void add(vtkMapper* mapper)
  {
    mapper->StaticOn(); // VTK walks its pipelines else, which is not ours to measure
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->renderer_->AddActor(actor);
    this->moved_ = actor;
  }

  /// Draws a frame after a change, by the pass or, without one, as VTK does, and reports on it.
  /// @return milliseconds, the change not among them
  double frame(const char* name, vtkRenderPass* pass, const std::function<void()>& change)
  {
    change();
    this->renderer_->SetPass(pass);
    resetPeak();
    const double before = processMegabytes("VmRSS");
    const auto start = std::chrono::steady_clock::now();
    this->window_->Render();
    this->window_->WaitForCompletion();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    std::cout << name << ": " << time.count() << " ms; resident " << before << " MB before, "
              << processMegabytes("VmHWM") << " at most, " << processMegabytes("VmRSS")
              << " after\n";
    if (pass)
    {
      this->reportStages();
    }
    return time.count();
  }

  void reportStages()
  {
    const FrameReport& report = this->pass_->GetReport();
    for (const StageTime& stage : report.stages)
    {
      std::cout << "    " << stage.name << " " << stage.milliseconds << " ms\n";
    }
    const auto each = [&](std::size_t bytes)
    { return static_cast<double>(bytes) / static_cast<double>(report.triangles); };
    std::cout << "    " << report.triangles << " triangles, extracted " << report.surfacesExtracted
              << ", retransformed " << report.surfacesRetransformed << ", built "
              << report.bvhBuilds << ", refitted " << report.bvhRefits << ", maps "
              << report.mapBakes << "\n    bytes a triangle: occluders "
              << each(report.bytesOccluders) << ", Embree " << each(report.bytesBvh) << "\n";
  }

  vtkNew<vtkGnomonEGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkGnomonShadowPass> pass_;
  vtkActor* moved_ = nullptr;
  std::vector<vtkSmartPointer<vtkPoints>> points_;
};

int run(int argc, char** argv)
{
  CLI::App app{ "Draws a large scene, and reports time and memory", "gnomon_benchmark_scale" };
  Options options;
  app.add_option("--triangles", options.triangles, "Triangles in all")
    ->check(CLI::Range(2, 100000000))
    ->capture_default_str();
  app.add_option("--props", options.props, "Props that they are shared among")
    ->check(CLI::Range(1, 1000000))
    ->capture_default_str();
  app.add_option("--blocks", options.blocks, "Blocks of one composite data set, in place of props")
    ->check(CLI::Range(1, 1000000));
  app.add_option("--technique", options.technique, "Shadow technique")->capture_default_str();
  app.add_option("--size", options.sidePixels, "Side of the window in pixels")
    ->check(CLI::Range(1, 16384))
    ->capture_default_str();
  app.add_option("--frames", options.frames, "Frames of each kind")
    ->check(CLI::Range(0, 1000))
    ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const VtkMessages messages;
  Benchmark(options).run(options.frames);
  if (!messages.errors().empty())
  {
    throw Failure("drawing: " + messages.errors().front());
  }
  return 0;
}

} // namespace
} // namespace gnomon::tool

int main(int argc, char** argv)
{
  return gnomon::tool::runBenchmark(
    "gnomon_benchmark_scale", [&] { return gnomon::tool::run(argc, argv); });
}
