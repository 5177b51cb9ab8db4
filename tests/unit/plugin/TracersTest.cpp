// The GPU's tracer gives the same result as Embree, for all techniques that trace.

#include "BuiltinScenes.h"
#include "LiveObjects.h"
#include "PassScene.h"
#include "Scene.h"

#include "shadowtech/Registry.h"
#include "shadowtech/base/Gl.h"

#include <vtkBoundingBox.h>
#include <vtkCollectionRange.h>
#include <vtkGlyph3DMapper.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkPoints.h>
#include <vtkRendererCollection.h>
#include <vtkSphereSource.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <random>
#include <sstream>
#include <vector>

using namespace gnomon::test;
using gnomon::FrameReport;
using gnomon::VisibilityImages;
using testing::HasSubstr;

namespace
{

constexpr int embree = vtkGnomonShadowPass::TRACER_EMBREE;
constexpr int gpu = vtkGnomonShadowPass::TRACER_GPU;

/// A frame's images and report.
struct Traced
{
  VisibilityImages images;
  FrameReport report;
};

Traced drawBy(
  vtkGnomonShadowPass* pass, vtkRenderWindow* window, const std::string& technique, int tracer)
{
  pass->SetTechnique(technique.c_str());
  pass->SetTracer(tracer);
  pass->KeepVisibilityOn();
  window->Render();
  EXPECT_EQ(pass->GetReport().tracer, tracer == gpu ? "gpu" : "embree");
  EXPECT_EQ(pass->GetReport().tracerReason, "asked for");
  return { pass->GetVisibility(), pass->GetReport() };
}

/// Count the pixels, of all lights, that differ between two frames.
std::size_t differing(const Traced& a, const Traced& b)
{
  EXPECT_EQ(a.images.visibility.size(), b.images.visibility.size());
  std::size_t count = 0;
  for (std::size_t light = 0; light < a.images.visibility.size(); ++light)
  {
    const std::vector<float>& one = a.images.visibility[light];
    const std::vector<float>& other = b.images.visibility[light];
    EXPECT_EQ(one.size(), other.size());
    count += static_cast<std::size_t>(std::inner_product(one.begin(), one.end(), other.begin(), 0,
      std::plus<>(), [](float x, float y) { return x != y ? 1 : 0; }));
  }
  return count;
}

/// Count the pixels, of all lights, that a ray decided.
std::int64_t rays(const Traced& frame)
{
  std::int64_t count = 0;
  for (const gnomon::LightReport& light : frame.report.lights)
  {
    count += light.tracedPixels;
  }
  return count;
}

/// Expect each light to take as many rays on the GPU as by Embree, and its pixels to have the same
/// classes. Only Embree skips tiles that are known without rays, so it may take fewer there.
void expectTheSameWork(const Traced& byGpu, const Traced& byEmbree, const std::string& what)
{
  for (std::size_t i = 0; i < byEmbree.report.lights.size(); ++i)
  {
    const gnomon::LightReport& light = byEmbree.report.lights[i];
    SCOPED_TRACE(what + ", light " + std::to_string(i));
    ASSERT_TRUE(light.casts);
    if (light.tilesLit + light.tilesDark > 0)
    {
      EXPECT_GE(byGpu.report.lights[i].tracedPixels, light.tracedPixels);
      continue;
    }
    EXPECT_EQ(byGpu.report.lights[i].tracedPixels, light.tracedPixels);
    EXPECT_EQ(byGpu.images.classes[i].ofPixels, byEmbree.images.classes[i].ofPixels);
  }
}

/// True if a pixel's visibility changes when all lights move by a millionth of the scene: its ray
/// passes an edge to within rounding.
bool isUndecided(vtkGnomonShadowPass* pass, vtkRenderWindow* window, std::size_t light,
  std::size_t pixel, float visibility)
{
  vtkRenderer* renderer = window->GetRenderers()->GetFirstRenderer();
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  const double nearness = 1e-6 * vtkBoundingBox(bounds).GetDiagonalLength();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-nearness, nearness);
  bool changes = false;
  for (int i = 0; i < 64 && !changes; ++i)
  {
    std::vector<std::array<double, 6>> places;
    const double by[3] = { uniform(random), uniform(random), uniform(random) };
    for (vtkLight* moved : vtk::Range(renderer->GetLights()))
    {
      const double* at = moved->GetPosition();
      const double* to = moved->GetFocalPoint();
      places.push_back({ at[0], at[1], at[2], to[0], to[1], to[2] });
      moved->SetPosition(at[0] + by[0], at[1] + by[1], at[2] + by[2]);
      moved->SetFocalPoint(to[0] - by[0], to[1] - by[1], to[2] - by[2]); // directions change, too
    }
    changes =
      drawBy(pass, window, "raytraced", embree).images.visibility[light][pixel] != visibility;
    auto place = places.begin();
    for (vtkLight* moved : vtk::Range(renderer->GetLights()))
    {
      moved->SetPosition(place->data());
      moved->SetFocalPoint(place->data() + 3);
      ++place;
    }
  }
  return changes;
}

/// Expect the GPU to agree with Embree, except for one ray plus one in a million that pass
/// an edge to within rounding.
void expectToAgree(
  vtkGnomonShadowPass* pass, vtkRenderWindow* window, const Traced& byGpu, const Traced& byEmbree)
{
  EXPECT_LE(differing(byGpu, byEmbree), rays(byEmbree) / 1000000 + 1);
  for (std::size_t light = 0; light < byEmbree.images.visibility.size(); ++light)
  {
    const std::vector<float>& one = byGpu.images.visibility[light];
    const std::vector<float>& other = byEmbree.images.visibility[light];
    for (std::size_t pixel = 0; pixel < other.size(); ++pixel)
    {
      if (one[pixel] != other[pixel])
      {
        EXPECT_TRUE(isUndecided(pass, window, light, pixel, other[pixel]))
          << "light " << light << ", pixel " << pixel;
      }
    }
  }
}

/// Expect all exact techniques on the GPU to equal ray tracing there, bit for bit, and that to
/// agree with Embree.
void expectTheSame(vtkGnomonShadowPass* pass, vtkRenderWindow* window)
{
  pass->SetSetting("bake", "always");
  const Traced byEmbree = drawBy(pass, window, "raytraced", embree);
  const Traced byGpu = drawBy(pass, window, "raytraced", gpu);
  std::ptrdiff_t dark = 0;
  for (const std::vector<float>& light : byGpu.images.visibility)
  {
    dark += std::count(light.begin(), light.end(), 0.0f);
  }
  EXPECT_GT(dark, 100);
  EXPECT_GT(rays(byGpu), 1000);
  expectTheSameWork(byGpu, byEmbree, "raytraced");
  expectToAgree(pass, window, byGpu, byEmbree);
  for (const gnomon::TechniqueEntry& technique : gnomon::registry())
  {
    const gnomon::TechniqueInfo& info = technique.estimator->info;
    if (!info.exact || !info.bakesMap())
    {
      continue;
    }
    const Traced hybrid = drawBy(pass, window, technique.name, gpu);
    EXPECT_EQ(differing(hybrid, byGpu), 0u) << technique.name;
    EXPECT_LT(rays(hybrid), rays(byGpu)) << technique.name;
    const Traced other = drawBy(pass, window, technique.name, embree);
    EXPECT_EQ(differing(other, byEmbree), 0u) << technique.name;
    expectTheSameWork(hybrid, other, technique.name);
  }
}

class TracersOfScene
  : public PassTest
  , public testing::WithParamInterface<std::string>
{
};

// Suns, spots, a lamp, open sheets, holes.
INSTANTIATE_TEST_SUITE_P(Builtin, TracersOfScene,
  testing::Values("plates", "screens", "cups", "office", "room"),
  [](const testing::TestParamInfo<std::string>& scene) { return scene.param; });

class Tracers : public PassTest
{
protected:
  Tracers()
  {
    this->scene.addFloor(4.0);
    this->sphere = this->scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
    this->scene.addSphere({ 1.5, 1.0, 0.6 }, 0.5);
    this->scene.addSun({ 1.0, 0.3, -1.5 });
    this->scene.addSpot({ -3.0, 0.0, 5.0 }, glm::dvec3(0.0), 30.0)->SetIntensity(0.5);
    this->scene.lookFrom({ 0.0, -9.0, 7.0 });
    this->scene.pass->SetTechnique("raytraced");
  }

  Picture render(int tracer)
  {
    this->scene.pass->SetTracer(tracer);
    return this->scene.render();
  }
  const FrameReport& report() const { return this->scene.report(); }

  PassScene scene{ 150, 110 };
  vtkActor* sphere;
};

} // namespace

//------------------------------------------------------------------------------
TEST_P(TracersOfScene, showTheSame)
{
  const vtkSmartPointer<vtkRenderer> renderer =
    gnomon::tool::makeRenderer(gnomon::tool::loadScene(GetParam()), 1.0);
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(170, 170); // tiles are cut at both borders
  window->AddRenderer(renderer);
  vtkNew<vtkGnomonShadowPass> pass;
  pass->SmoothTerminatorsOff();
  renderer->SetPass(pass);
  expectTheSame(pass, window);
}

//------------------------------------------------------------------------------
TEST_F(Tracers, showTheSameOfAreaLights)
{
  this->scene.pass->SetSetting("light_radius", "0.8");
  for (const char* samples :
    { "1", "16", "49", "300" }) // the GPU takes the last ones in several batches
  {
    this->scene.pass->SetSetting("light_samples", samples);
    const Traced byEmbree = drawBy(this->scene.pass, this->scene.window, "raytraced", embree);
    const Traced byGpu = drawBy(this->scene.pass, this->scene.window, "raytraced", gpu);
    EXPECT_EQ(byGpu.report.lights[0].lightSamples, std::stoi(samples));
    EXPECT_EQ(rays(byGpu), rays(byEmbree));
    EXPECT_GT(rays(byGpu), 5000) << "pixels";
    // A ray in a million may pass an edge to within rounding.
    EXPECT_LE(static_cast<double>(differing(byGpu, byEmbree)),
      1.0 + 1e-6 * static_cast<double>(rays(byEmbree) * std::stoi(samples)));
    EXPECT_EQ(byGpu.images.classes[0].ofPixels, byEmbree.images.classes[0].ofPixels);
  }
}

//------------------------------------------------------------------------------
TEST_F(Tracers, showTheSameOfInstancesAndFollowThem)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.1);
  vtkNew<vtkPolyData> points;
  points->SetPoints(vtkNew<vtkPoints>());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 3000; ++i)
  {
    points->GetPoints()->InsertNextPoint(
      3.0 * uniform(random), 3.0 * uniform(random), 1.5 + uniform(random));
  }
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(points);
  mapper->SetSourceConnection(ball->GetOutputPort());
  mapper->ScalingOff();
  vtkNew<vtkActor> glyphs;
  glyphs->SetMapper(mapper);
  this->scene.renderer->AddActor(glyphs);
  expectTheSame(this->scene.pass, this->scene.window);
  EXPECT_EQ(this->report().instances, 3000u);

  const Traced before = drawBy(this->scene.pass, this->scene.window, "raytraced", gpu);
  glyphs->SetPosition(0.3, -0.2, 0.1);
  const Traced after = drawBy(this->scene.pass, this->scene.window, "raytraced", gpu);
  EXPECT_EQ(after.report.bvhRefits, 1);
  EXPECT_EQ(after.report.bvhBuilds, 0);
  EXPECT_GT(differing(before, after), 500u);
  EXPECT_EQ(
    differing(after, drawBy(this->scene.pass, this->scene.window, "raytraced", embree)), 0u);
}

//------------------------------------------------------------------------------
TEST_F(Tracers, changeBackAndForthAndLeaveNothingBehind)
{
  const Picture picture = this->render(embree);
  const LiveObjects live = countLiveObjects(this->scene.window);
  const std::size_t bytesOfEmbree = this->report().bytesBvh;
  const std::size_t bytesOfImages = this->report().bytesImages;
  std::size_t bytesOfGpu = 0;
  LiveObjects liveOnGpu;
  for (int time = 0; time < 3; ++time)
  {
    EXPECT_EQ(differingPixels(picture, this->render(gpu)), 0u);
    EXPECT_EQ(this->report().tracer, "gpu");
    EXPECT_EQ(this->report().bvhBuilds, 1);
    EXPECT_GT(this->report().bytesImages, bytesOfImages + 110u * 150u * 32u);
    bytesOfGpu = time == 0 ? this->report().bytesBvh : bytesOfGpu;
    EXPECT_EQ(this->report().bytesBvh, bytesOfGpu);
    liveOnGpu = time == 0 ? countLiveObjects(this->scene.window) : liveOnGpu;
    EXPECT_EQ(countLiveObjects(this->scene.window), liveOnGpu);
    this->render(gpu);
    EXPECT_EQ(this->report().bvhBuilds, 0);
    EXPECT_EQ(this->report().programCompiles, 0);

    EXPECT_EQ(differingPixels(picture, this->render(embree)), 0u);
    EXPECT_EQ(this->report().tracer, "embree");
    EXPECT_EQ(this->report().bvhBuilds, 3);
    EXPECT_EQ(this->report().bytesBvh, bytesOfEmbree);
    // With several lights, receivers are stored from the first image on.
    EXPECT_EQ(this->report().bytesImages, bytesOfImages);
    this->render(embree);
    EXPECT_EQ(this->report().bvhBuilds, 0);
  }
  // The snapshot's vertices stay on the GPU, as they do after a map: two buffers and the objects
  // that draw them.
  EXPECT_GT(liveOnGpu.buffers, countLiveObjects(this->scene.window).buffers + 6);
  EXPECT_LE(countLiveObjects(this->scene.window).buffers, live.buffers + 3);
}

//------------------------------------------------------------------------------
TEST_F(Tracers, areChosenByWhoDrawsUnlessSomeoneAsks)
{
  EXPECT_EQ(this->scene.pass->GetTracer(), vtkGnomonShadowPass::TRACER_AUTO);
  this->render(vtkGnomonShadowPass::TRACER_AUTO);
  const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const bool software = renderer.find("llvmpipe") != std::string::npos;
  EXPECT_EQ(this->report().tracer, software ? "embree" : "gpu");
  EXPECT_THAT(this->report().tracerReason, HasSubstr(renderer));
  this->scene.pass->SetTracer(17);
  EXPECT_EQ(this->scene.pass->GetTracer(), gpu);
  std::ostringstream text;
  this->scene.pass->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("Tracer: gpu"));
}
