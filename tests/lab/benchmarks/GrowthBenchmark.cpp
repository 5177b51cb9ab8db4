// Measure how a frame's time grows with triangles, props, programs, lights, pixels and movement.
// Each axis varies one of these from a base scene. Plain VTK, vtkShadowMapPass and Gnomon's
// techniques draw frames in turn, so other load on the machine affects all alike.

#include "BenchmarkMain.h"
#include "Commands.h"
#include "Errors.h"
#include "Files.h"
#include "FrameVariant.h"
#include "MeshBuilder.h"
#include "Progress.h"
#include "Report.h"
#include "VtkMessages.h"

#include "plugin/plan/BakeBackoff.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkMath.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tool
{
namespace
{

constexpr int mapSizeTexels = 1024;
constexpr int baseTriangles = 100000;
constexpr int fewestFrames = 3;
/// The most seconds that the frames of a case take, unless `fewestFrames` take longer.
constexpr double secondsPerCase = 60.0;

const std::vector<std::string> axisKeys = { "triangles", "props", "programs", "lights", "pixels",
  "movement" };

struct Options
{
  std::string folder;
  std::vector<std::string> axes = axisKeys;
  std::vector<std::string> techniques = { "nsm", "silhouette", "raytraced" };
  int frames = 25;
  int mostTriangles = 10000000;
  int mostProps = 10000;
  int sidePixels = 1024;
};

using Variants = std::vector<std::unique_ptr<FrameVariant>>;

/// One contender in one case.
struct Measurement
{
  std::string notDrawn; ///< the reason; empty if it is drawn
  double firstMilliseconds = 0.0;
  std::vector<double> times; ///< of the frames that count, in milliseconds
};

struct Case
{
  std::string name;
  double x = 0.0; ///< its place on the axis; 0: the axis has no scale
  int triangles = baseTriangles;
  int lights = 1;
  int columns = 1; ///< of props into which the surface is cut
  int rows = 1;
  int programs = 1; ///< of shaders, which the props have in turn
  PictureSize size;
  Motion motion = Motion::Camera;
  /// Move anything but the camera and lights, before each round of frames.
  std::function<void(const Scene&, const Variants&, int step)> move = {};
};

struct Axis
{
  std::string key;
  std::vector<Case> cases;
};

// Scenes

double hillHeight(double x, double z, double time)
{
  return 0.03 * std::sin(40.0 * x + time) * std::cos(31.0 * z);
}

/// Return a rectangle of hills of about that many triangles, its corner at (x, z).
SceneModel makeHills(double triangles, double x, double z, double width, double depth)
{
  const int cells = std::max(1, static_cast<int>(std::lround(std::sqrt(0.5 * triangles))));
  MeshBuilder mesh;
  mesh.addPatch(cells, cells,
    [&](double u, double v)
    {
      const double placeX = x + u * width;
      const double placeZ = z - v * depth;
      return SurfacePoint{ { { placeX, hillHeight(placeX, placeZ, 0.0), placeZ } }, up };
    });
  SceneModel model = makeModel("hills", mesh.build(), { { 0.6, 0.62, 0.4 } });
  model.surface->GetPointData()->SetNormals(nullptr); // VTK shades facets of moved vertices
  return model;
}

/// Return a square of hills under suns that stand around it.
Scene makeScene(const Case& drawn)
{
  Scene scene;
  const double width = 1.0 / drawn.columns;
  const double depth = 1.0 / drawn.rows;
  for (int i = 0; i < drawn.columns * drawn.rows; ++i)
  {
    scene.models.push_back(makeHills(drawn.triangles * width * depth,
      i % drawn.columns * width - 0.5, 0.5 - i / drawn.columns * depth, width, depth));
  }
  for (int i = 0; i < drawn.lights; ++i)
  {
    const double turn = 0.6 + 2.0 * vtkMath::Pi() * i / drawn.lights;
    scene.lights.push_back(
      makeSun({ { std::cos(turn), -0.6, std::sin(turn) } }, 1.0 / drawn.lights));
  }
  scene.camera = makeCamera({ { 0.0, 0.75, 1.1 } }, { { 0.0, -0.05, 0.0 } }, 45.0);
  return scene;
}

/// Have a renderer's props drawn by so many programs. A uniform that nothing reads makes another
/// program of the same cost.
void spreadOverPrograms(vtkRenderer* renderer, int programs)
{
  vtkActorCollection* const actors = renderer->GetActors();
  vtkCollectionSimpleIterator iterator;
  actors->InitTraversal(iterator);
  int number = 0;
  while (vtkActor* const actor = actors->GetNextActor(iterator))
  {
    const std::string name = "program" + std::to_string(number++ % programs);
    actor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf(name.c_str(), 0.0f);
  }
}

void liftOneProp(const Scene& /*scene*/, const Variants& variants, int step)
{
  for (const std::unique_ptr<FrameVariant>& variant : variants)
  {
    vtkActorCollection* const actors = variant->renderer()->GetActors();
    vtkObject* const middle = actors->GetItemAsObject(actors->GetNumberOfItems() / 2);
    vtkActor::SafeDownCast(middle)->SetPosition(0.0, 1e-3 * step, 0.0);
  }
}

/// Move a wave of hills along x.
void moveAllVertices(const Scene& scene, const Variants& /*variants*/, int step)
{
  vtkPoints* const points = scene.models.front().surface->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Vec3 place;
    points->GetPoint(i, place.data());
    points->SetPoint(i, place[0], hillHeight(place[0], place[2], 0.1 * step), place[2]);
  }
  points->Modified();
}

// Cases

/// Return a number with separators: "1,000,000".
std::string grouped(int number)
{
  std::string text = std::to_string(number);
  for (int end = static_cast<int>(text.size()) - 3; end > 0; end -= 3)
  {
    text.insert(static_cast<std::size_t>(end), ",");
  }
  return text;
}

/// Return all axes, in the order of axisKeys.
std::vector<Axis> makeAxes(const Options& options)
{
  Case base;
  base.triangles = std::min(baseTriangles, options.mostTriangles);
  base.size = { options.sidePixels, options.sidePixels };
  const auto named = [&](const std::string& name, double x)
  {
    Case varied = base;
    varied.name = name;
    varied.x = x;
    return varied;
  };

  const auto numbered = [&](const std::string& key, int most, const std::vector<int>& numbers,
                          const std::function<void(Case&, int)>& set)
  {
    Axis axis{ key, {} };
    for (const int number : numbers)
    {
      if (number <= most || axis.cases.empty())
      {
        const int drawn = std::min(number, most);
        axis.cases.push_back(named(grouped(drawn), drawn));
        set(axis.cases.back(), drawn);
      }
    }
    return axis;
  };
  std::vector<Axis> axes = {
    numbered("triangles", options.mostTriangles, { 10000, 100000, 1000000, 10000000 },
      [](Case& of, int triangles) { of.triangles = triangles; }),
    numbered("props", options.mostProps, { 10, 100, 1000, 10000 },
      [](Case& of, int props)
      {
        static const std::map<int, int> rows = { { 10, 2 }, { 100, 10 }, { 1000, 25 },
          { 10000, 100 } };
        of.rows = rows.at(props);
        of.columns = props / of.rows;
      }),
    numbered("programs", options.mostProps, { 1, 10, 100 },
      [](Case& of, int programs)
      {
        of.columns = of.rows = 10;
        of.programs = programs;
      }),
    numbered("lights", 8, { 1, 2, 4, 8 }, [](Case& of, int lights) { of.lights = lights; }),
  };
  Axis pixels{ "pixels", {} };
  for (const auto& [width, height] :
    { std::pair(512, 512), { 1024, 1024 }, { 1920, 1080 }, { 3840, 2160 } })
  {
    // For a base of 1024 x 1024; another base scales in proportion.
    const PictureSize size{ width * options.sidePixels / 1024, height * options.sidePixels / 1024 };
    pixels.cases.push_back(named(std::to_string(size.width) + " x " + std::to_string(size.height),
      static_cast<double>(size.width) * size.height));
    pixels.cases.back().size = size;
  }
  base.motion = Motion::Static;
  Axis movement{ "movement",
    { named("1,000 props at rest", 0.0), named("one of them moving", 0.0),
      named("one surface at rest", 0.0), named("all its vertices moving", 0.0) } };
  movement.cases[0].columns = movement.cases[1].columns = 40;
  movement.cases[0].rows = movement.cases[1].rows = 25;
  movement.cases[1].move = liftOneProp;
  movement.cases[3].move = moveAllVertices;
  axes.insert(axes.end(), { pixels, movement });
  return axes;
}

// Measuring

/// Return why the last frame is broken or lacks shadows; empty if it is fine.
std::string whyNotDrawn(const FrameVariant& variant, const VtkMessages& messages)
{
  if (!messages.errors().empty())
  {
    return messages.errors().front();
  }
  if (!variant.pass())
  {
    return {};
  }
  const FrameReport& report = variant.pass()->GetReport();
  if (report.outOfTextureMemory)
  {
    return "maps or images are too large for the texture memory";
  }
  const auto dark = std::find_if(report.lights.begin(), report.lights.end(),
    [](const LightReport& light) { return !light.casts; });
  return dark == report.lights.end() ? std::string() : dark->reason;
}

/// A case drawn by all contenders.
class CaseRun
{
public:
  CaseRun(const Case& drawn, const std::vector<VariantSpec>& contenders)
    : case_(drawn)
    , scene_(makeScene(drawn))
    , results_(contenders.size())
  {
    for (const VariantSpec& spec : contenders)
    {
      this->variants_.push_back(
        std::make_unique<FrameVariant>(spec, this->scene_, drawn.size.width, drawn.size.height));
      spreadOverPrograms(this->variants_.back()->renderer(), drawn.programs);
    }
  }

  /// Draw the first frames and the warm-up frames, which do not count.
  void warmUp()
  {
    this->drawRound();
    for (Measurement& result : this->results_)
    {
      result.firstMilliseconds = median(result.times);
    }
    for (int round = 0; round < warmUpFrames; ++round)
    {
      this->drawRound();
    }
    if (this->case_.motion == Motion::Camera) // other motion makes maps stale
    {
      this->awaitMaps();
    }
    for (Measurement& result : this->results_)
    {
      result.times.clear();
    }
  }

  /// Draw a frame of each contender.
  void drawRound()
  {
    this->move();
    for (std::size_t i = 0; i < this->variants_.size(); ++i)
    {
      this->drawFrame(i);
    }
  }

  /// The time of all frames since warmUp().
  double seconds() const
  {
    double milliseconds = 0.0;
    for (const Measurement& result : this->results_)
    {
      milliseconds += std::accumulate(result.times.begin(), result.times.end(), 0.0);
    }
    return 1e-3 * milliseconds;
  }

  /// Return the table's lines of this case.
  /// @param contenders their names
  std::string lines(const std::string& axis, const std::vector<std::string>& contenders) const
  {
    std::string text;
    const Measurement& plain = this->results_.front();
    for (std::size_t i = 0; i < contenders.size(); ++i)
    {
      const Measurement& own = this->results_[i];
      const double milliseconds = median(own.times);
      nlohmann::ordered_json cells[4];
      if (own.notDrawn.empty())
      {
        cells[0] = milliseconds;
      }
      if (own.notDrawn.empty() && plain.notDrawn.empty())
      {
        cells[1] = milliseconds / median(plain.times);
      }
      cells[2] = own.firstMilliseconds;
      if (vtkGnomonShadowPass* const pass = this->variants_[i]->pass())
      {
        const FrameReport& report = pass->GetReport();
        cells[3] = static_cast<double>(report.bytesOccluders + report.bytesBvh) /
          static_cast<double>(std::max<std::size_t>(1, report.triangles));
      }
      text += csvLine({ axis, this->case_.name, contenders[i], cells[0], cells[1], cells[2],
        cells[3], own.notDrawn });
    }
    return text;
  }

private:
  /// Bake maps that must first pay off, so that all frames that count are of one kind.
  void awaitMaps()
  {
    for (std::size_t i = 0; i < this->variants_.size(); ++i)
    {
      for (int frame = 0; frame <= BakeBackoff::leastPatience && this->variants_[i]->awaitsMap() &&
           this->seconds() < 2.0 * secondsPerCase;
           ++frame)
      {
        this->move();
        this->drawFrame(i);
      }
    }
  }

  void move()
  {
    ++this->step_;
    if (this->case_.move)
    {
      this->case_.move(this->scene_, this->variants_, this->step_);
    }
  }

  void drawFrame(std::size_t contender)
  {
    Measurement& result = this->results_[contender];
    if (!result.notDrawn.empty())
    {
      return;
    }
    const VtkMessages messages;
    try
    {
      FrameVariant& variant = *this->variants_[contender];
      result.times.push_back(variant.drawFrame(this->case_.motion, this->step_));
      result.notDrawn = whyNotDrawn(variant, messages);
    }
    catch (const std::exception& error)
    {
      result.notDrawn = error.what();
    }
  }

  const Case& case_;
  const Scene scene_;
  Variants variants_;
  std::vector<Measurement> results_;
  int step_ = 0;
};

/// Draw all cases of an axis in turn.
/// @return the table's lines
std::string measure(const Axis& axis, const std::vector<VariantSpec>& contenders,
  const std::vector<std::string>& names, int frames,
  const std::function<void(const std::string&)>& stepBegins)
{
  std::vector<std::unique_ptr<CaseRun>> runs;
  for (const Case& drawn : axis.cases)
  {
    stepBegins(axis.key + ", first frames of " + drawn.name);
    runs.push_back(std::make_unique<CaseRun>(drawn, contenders));
    runs.back()->warmUp();
  }
  for (int round = 0; round < frames; ++round)
  {
    stepBegins(axis.key + ", round " + std::to_string(round + 1) + " of " + std::to_string(frames));
    for (const std::unique_ptr<CaseRun>& run : runs)
    {
      // Slow cases skip rounds.
      if (round < fewestFrames || run->seconds() < secondsPerCase * round / frames)
      {
        run->drawRound();
      }
    }
  }
  std::string lines;
  for (const std::unique_ptr<CaseRun>& run : runs)
  {
    lines += run->lines(axis.key, names);
  }
  return lines;
}

// The program

int run(int argc, char** argv)
{
  CLI::App app{ "Measures how a frame's time grows with its scene and with what moves",
    "gnomon_benchmark_growth" };
  Options options;
  app.add_option("-o,--output", options.folder, "Folder for growth.csv")->required();
  addTexts(app, "--axes", options.axes, "What to vary, separated by commas")
    ->check(CLI::IsMember(axisKeys));
  addTexts(app, "--techniques", options.techniques, "As of gnomon compare");
  addNumber(app, "--frames", options.frames, 1, 1000,
    "Timed frames of each contender and case; fewer of slow cases");
  addNumber(
    app, "--most-triangles", options.mostTriangles, 2, 100000000, "Triangles of the largest scene");
  addNumber(
    app, "--most-props", options.mostProps, 10, 10000, "Props and programs of the largest scenes");
  addNumber(app, "--size", options.sidePixels, 16, 4096, "Side of the base picture in pixels");
  CLI11_PARSE(app, argc, argv);

  const VtkMessages messages;
  std::vector<std::string> names = { plainTechnique, shadowMapPassTechnique };
  std::vector<VariantSpec> specs = { { plainTechnique },
    { shadowMapPassTechnique, mapSizeTexels } };
  for (const std::string& text : options.techniques)
  {
    names.push_back(text);
    specs.push_back(parseTechnique(text));
    const bool bakes = estimatorOf(settingsOf(specs.back())).info.bakesMap();
    specs.back().mapSizeTexels = bakes ? mapSizeTexels : 0;
  }
  prepareReportFolder(options.folder, "growth.csv");
  const auto window = makeOffScreenWindow();
  window->Render(); // initialises OpenGL, for which the first contender would pay
  Progress progress("starting");
  std::string table = csvLine({ "axis", "case", "contender", "milliseconds", "over plain",
    "first milliseconds", "bytes a triangle", "not drawn" });
  for (const Axis& axis : makeAxes(options))
  {
    if (std::count(options.axes.begin(), options.axes.end(), axis.key))
    {
      table += measure(
        axis, specs, names, options.frames, [&](const std::string& step) { progress.begin(step); });
      writeWholeFile(options.folder + "/growth.csv", table);
    }
  }
  if (!messages.errors().empty())
  {
    throw Failure(messages.errors().front());
  }
  progress.print(options.folder + "/growth.csv", std::cout);
  return 0;
}

} // namespace
} // namespace gnomon::tool

int main(int argc, char** argv)
{
  return gnomon::tool::runBenchmark(
    "gnomon_benchmark_growth", [&] { return gnomon::tool::run(argc, argv); });
}
