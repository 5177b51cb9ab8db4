// Several processes, each with a part of a scene, show the shadows that one process with all of it
// shows.

#include "SplitScene.h"

#include "shadowtech/base/Gl.h"

#include <vtkAssembly.h>
#include <vtkCollectionRange.h>
#include <vtkGlyph3DMapper.h>
#include <vtkOpenGLActor.h>

#include <stdexcept>

namespace gnomon::test
{
namespace
{

/// Add spheres of 100 triangles at points, as glyphs.
void addSpheres(RankView& view, vtkPoints* points, double radius)
{
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceConnection(ballOf(glm::dvec3(0.0), radius, 10, 7)->GetOutputPort());
  mapper->ScalingOff();
  view.renderer->AddActor(actorOf(mapper));
}

/// Give the first light an area.
std::function<void(vtkRenderer*)> softened(const char* radius, const char* samples)
{
  return [=](vtkRenderer* renderer)
  {
    set(lightOf(renderer), "light_radius", radius);
    set(lightOf(renderer), "light_samples", samples);
  };
}

std::string nameOf(const Distribution& distribution)
{
  return distribution.name;
}
std::string nameOf(const std::tuple<std::string, Distribution>& split)
{
  return std::get<0>(split) + "_" + std::get<1>(split).name;
}
constexpr auto byItsName = [](const auto& info) { return nameOf(info.param); };

using Split = std::tuple<std::string, Distribution>;

using SharedPicture = PassTestOf<Split>;

INSTANTIATE_TEST_SUITE_P(Scenes, SharedPicture,
  testing::Combine(testing::Values("bunny", "atrium", "terrain", "posts"),
    testing::Values(blocks, roundRobin, byChance, blocksWithGhosts)),
  byItsName);

TEST_P(SharedPicture, EqualsThatOfOneProcess)
{
  SplitScene scene(tool::loadScene(std::get<0>(GetParam())), std::get<1>(GetParam()));
  EXPECT_GT(scene.expectSame(), 0u);
  scene.turnCamera(20.0);
  EXPECT_GT(scene.expectSame(), 0u);
  scene.change(
    [](vtkRenderer* renderer)
    {
      const glm::dvec3 position = glm::make_vec3(lightOf(renderer)->GetPosition());
      lightOf(renderer)->SetPosition(position.x + 0.5, position.y, position.z + 0.7);
    });
  EXPECT_GT(scene.expectSame(), 0u);
  scene.change(
    [](vtkRenderer* renderer)
    {
      auto* last = renderer->GetActors()->GetLastActor();
      last->RotateZ(7.0);
      last->SetScale(1.1);
    });
  EXPECT_GT(scene.expectSame(), 0u);
}

/// A scene over a floor, split in blocks.
tool::Scene boxScene(const std::function<void(tool::SceneLight&)>& shape)
{
  tool::Scene scene = tool::loadScene("posts");
  scene.lights.resize(1);
  shape(scene.lights.front());
  return scene;
}

using SharedLights = PassTestOf<const char*>;

INSTANTIATE_TEST_SUITE_P(
  Kinds, SharedLights, testing::Values("sun", "spot", "point", "area"), byText);

TEST_P(SharedLights, EqualThoseOfOneProcess)
{
  const std::string kind = GetParam();
  SplitScene scene(boxScene(
                     [&](tool::SceneLight& light)
                     {
                       light.type = kind == "spot" ? tool::SceneLight::Type::Spot
                         : kind == "point"         ? tool::SceneLight::Type::Point
                                                   : tool::SceneLight::Type::Directional;
                       light.coneAngleDegrees = 40.0;
                       if (kind == "area")
                       {
                         light.settings["light_radius"] = "2";
                         light.settings["light_samples"] = "16";
                       }
                     }),
    roundRobin);
  EXPECT_GT(scene.expectSame(), 0u);
  EXPECT_EQ(scene.shared().report().lights.front().lightSamples, kind == "area" ? 16 : 1);
}

/// The first process' budget leaves all of them one sample in motion. At rest all samples show.
TEST(SharedBudget, leavesMotionFewerSamples)
{
  SplitScene scene(boxScene(
                     [](tool::SceneLight& light)
                     {
                       light.settings["light_radius"] = "2";
                       light.settings["light_samples"] = "16";
                     }),
    roundRobin);
  vtkGnomonShadowPass& pass = *scene.shared().pass;
  for (const char* const technique : { "raytraced", "auto" })
  {
    SCOPED_TRACE(technique);
    pass.SetTechnique(technique);
    pass.SetTimeBudget(controller()->GetLocalProcessId() == 0 ? 1e-3 : 1e6);
    pass.SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
    for (int frame = 0; frame < 4; ++frame)
    {
      scene.turnCamera(3.0);
      scene.shared().draw();
    }
    EXPECT_EQ(pass.GetProgress(), 1.0 / 16.0);
    pass.SetInteractive(vtkGnomonShadowPass::INTERACTIVE_OFF);
    EXPECT_GT(scene.expectSame(), 0u);
    EXPECT_EQ(pass.GetProgress(), 1.0);
  }
}

using SharedEdges = PassTestOf<Split>;

INSTANTIATE_TEST_SUITE_P(Scenes, SharedEdges,
  testing::Combine(
    testing::Values("bunny", "posts", "props"), testing::Values(byChance, blocksWithGhosts)),
  byItsName);

TEST_P(SharedEdges, EqualThoseOfOneProcess)
{
  SplitScene scene(tool::loadScene(std::get<0>(GetParam())), std::get<1>(GetParam()));
  const auto smooth = [&](const char* samples)
  {
    scene.smooth(samples);
    EXPECT_GT(scene.expectSame(), 0u);
    EXPECT_GT(scene.mixedPixels(), 0u) << samples;
  };
  EXPECT_GT(scene.expectSame(), 0u);
  EXPECT_EQ(scene.mixedPixels(), 0u);
  smooth("16"); // the receivers stay
  scene.turnCamera(10.0);
  smooth("4");
  smooth("64");
}

/// VTK's default sphere and a stone in front of it, over a floor.
tool::Scene coarseScene()
{
  tool::Scene scene;
  for (const vtkSmartPointer<vtkPolyData>& surface : { outputOf(vtkNew<vtkSphereSource>()),
         outputOf(squareOf(2.0, -0.6)), outputOf(ballOf({ 0.45, -0.35, 0.25 }, 0.12, 4, 4)) })
  {
    tool::SceneModel& model = scene.models.emplace_back();
    model.surface = surface;
    model.property = vtkSmartPointer<vtkProperty>::New();
  }
  scene.camera = { { 1.0, -2.4, 1.4 }, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, 35.0, {} };
  scene.lights.emplace_back().position = { 3.0, -0.5, 1.5 };
  return scene;
}

struct SharedTerminators : PassTestOf<Distribution>
{
  /// Expect the same pictures without and with smooth terminators, and that these differ in more
  /// than `least` pixels.
  void expectSmooth(SplitScene& scene, std::size_t least)
  {
    scene.smoothTerminators(false);
    scene.expectSame();
    const std::vector<float> facets = scene.shared().pass->GetVisibility().visibility.front();
    scene.smoothTerminators(true);
    scene.expectSame();
    const std::vector<float>& smooth = scene.shared().pass->GetVisibility().visibility.front();
    EXPECT_GT(countDifferences(smooth, facets), least);
  }
};

INSTANTIATE_TEST_SUITE_P(Splits, SharedTerminators,
  testing::Values(wholes, blocks, roundRobin, byChance, blocksWithGhosts), byItsName);

TEST_P(SharedTerminators, EqualThoseOfOneProcess)
{
  SplitScene scene(coarseScene(), GetParam());
  this->expectSmooth(scene, 50);
  scene.turnCamera(20.0);
  this->expectSmooth(scene, 50);
  scene.change(
    [](vtkRenderer* renderer)
    {
      auto* first = vtkActor::SafeDownCast(renderer->GetActors()->GetItemAsObject(0));
      first->RotateX(20.0);
      first->SetScale(1.1, 0.8, 1.0);
    });
  this->expectSmooth(scene, 50);
  scene.smooth("16");
  this->expectSmooth(scene, 50);
  scene.smooth("1");
  scene.change(softened("4", "64"));
  this->expectSmooth(scene, 50);
}

TEST_P(SharedTerminators, EqualThoseOfOneProcessOnInstances)
{
  SplitScene scene(coarseScene(), GetParam());
  const int own = controller()->GetLocalProcessId();
  const int ranks = controller()->GetNumberOfProcesses();
  const auto add = [](RankView& view, const std::function<bool(vtkIdType)>& has)
  {
    vtkNew<vtkPoints> points;
    for (vtkIdType i = 0; i < 3000; ++i)
    {
      if (has(i))
      {
        points->InsertNextPoint(
          0.8 + 0.05 * (i % 20), -0.05 * (i / 20 % 20), -0.5 + 0.05 * (i / 400));
      }
    }
    addSpheres(view, points, 0.02);
  };
  add(scene.shared(), [&](vtkIdType i) { return GetParam().rankOf(i, 3000, ranks) == own; });
  add(scene.alone(), [](vtkIdType) { return true; });
  scene.change(
    [](vtkRenderer* renderer)
    {
      renderer->GetActiveCamera()->SetFocalPoint(1.2, -0.4, -0.2);
      renderer->GetActiveCamera()->SetViewAngle(6.0);
    });
  this->expectSmooth(scene, 50);
  EXPECT_EQ(scene.alone().report().instances, 3000u);
}

/// An actor whose next drawing may throw.
class FailingActor : public vtkOpenGLActor
{
public:
  static constexpr const char* error = "the actor fails";

  static FailingActor* New();
  vtkTypeMacro(FailingActor, vtkOpenGLActor);

  void failNext() { this->fails_ = true; }

  int RenderOpaqueGeometry(vtkViewport* viewport) override
  {
    if (std::exchange(this->fails_, false))
    {
      throw std::runtime_error(error);
    }
    return this->vtkOpenGLActor::RenderOpaqueGeometry(viewport);
  }

private:
  bool fails_ = false;
};
vtkStandardNewMacro(FailingActor);

struct SharedFrames : PassTest
{
  SplitScene scene_{ tool::loadScene("posts"), blocks };
  const int own_ = controller()->GetLocalProcessId();
  const int last_ = controller()->GetNumberOfProcesses() - 1;
  vtkNew<FailingActor> failing_;

  /// Expect an error since the last call, and return it.
  std::string takeError()
  {
    const std::string errors = this->takeErrors();
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
    return errors;
  }
  /// Make the next frame fail in the last process.
  void failNext()
  {
    if (this->own_ != this->last_)
    {
      return;
    }
    vtkRenderer* const renderer = this->scene_.shared().renderer;
    if (!renderer->HasViewProp(this->failing_))
    {
      const auto cellsOf = [](vtkActor* actor)
      {
        return vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputDataObject(0, 0))
          ->GetNumberOfCells();
      };
      const auto actors = vtk::Range(renderer->GetActors());
      vtkActor* const replaced = *std::max_element(actors.begin(), actors.end(),
        [&](vtkActor* a, vtkActor* b) { return cellsOf(a) < cellsOf(b); });
      this->failing_->ShallowCopy(replaced);
      renderer->AddActor(this->failing_);
      renderer->RemoveActor(replaced);
    }
    this->failing_->failNext();
  }

  void showOwn(bool show)
  {
    for (vtkActor* actor : vtk::Range(this->scene_.shared().renderer->GetActors()))
    {
      actor->SetVisibility(show);
    }
  }
};

TEST_F(SharedFrames, RestWithoutWork)
{
  this->scene_.expectSame();
  this->scene_.expectSame();
  const FrameReport& report = this->scene_.shared().report();
  EXPECT_EQ(report.receiversDrawn, 0);
  EXPECT_EQ(report.visibilityComputed, 0);
  EXPECT_LT(report.bytesShared, 100);
  EXPECT_EQ(report.processes, this->last_ + 1);
}

TEST_F(SharedFrames, GoOnWhereOneProcessHasNothing)
{
  this->scene_.expectSame();
  const std::vector<float> before = this->scene_.shared().pass->GetVisibility().visibility.front();
  this->showOwn(this->own_ != this->last_);
  this->scene_.shared().draw();
  const std::vector<float>& without =
    this->scene_.shared().pass->GetVisibility().visibility.front();
  EXPECT_NE(without, before);
  if (this->own_ == this->last_)
  {
    EXPECT_EQ(this->scene_.shared().report().ownReceivers, 0);
    EXPECT_GT(this->scene_.shared().report().lights.front().rays, 0); // for the others
  }
  this->showOwn(true);
  this->scene_.expectSame();
}

TEST_F(SharedFrames, HoldGlyphsByTheirNumberInAllProcesses)
{
  constexpr int few = 2000; // of 100 triangles each: too few to be held as instances
  constexpr int many = 3000;
  const int ranks = this->last_ + 1;
  vtkNew<vtkPoints> own, all;
  const auto fill = [&](int first, int end, const std::function<int(int)>& ownerOf)
  {
    for (int i = first; i < end; ++i)
    {
      const double place[] = { 2.0 * std::cos(0.37 * i), 2.0 * std::sin(0.37 * i), 0.001 * i };
      all->InsertNextPoint(place);
      if (ownerOf(i) == this->own_)
      {
        own->InsertNextPoint(place);
        own->Modified();
      }
    }
    all->Modified();
  };
  fill(0, few, [&](int i) { return i % ranks; });
  addSpheres(this->scene_.shared(), own, 0.03);
  addSpheres(this->scene_.alone(), all, 0.03);
  this->scene_.expectSame();
  EXPECT_EQ(this->scene_.alone().report().instances, 0u);
  EXPECT_EQ(this->scene_.shared().report().instances, 0u);
  const auto expectInstances = [&]
  {
    this->scene_.expectSame();
    EXPECT_EQ(this->scene_.alone().report().instances, static_cast<std::size_t>(many));
    EXPECT_EQ(
      this->scene_.shared().report().instances, static_cast<std::size_t>(own->GetNumberOfPoints()));
  };
  fill(few, many, [&](int) { return this->last_; }); // the others' data stay as they are
  const auto changeMapper = [](RankView& view)
  {
    auto* mapper = vtkMapper::SafeDownCast(view.renderer->GetActors()->GetLastActor()->GetMapper());
    mapper->GetInputDataObject(0, 0)->Modified();
  };
  changeMapper(this->scene_.alone());
  if (this->own_ == this->last_)
  {
    changeMapper(this->scene_.shared());
  }
  expectInstances();
  this->scene_.change(
    [](vtkRenderer* renderer) { renderer->GetActors()->GetLastActor()->SetScale(-1.0, 1.0, 1.0); });
  expectInstances();
}

TEST_F(SharedFrames, SmoothEdgesBetweenPartsOfAnAssembly)
{
  constexpr int parts = 5;
  const auto add = [](RankView& view, const std::function<bool(int)>& has)
  {
    vtkNew<vtkAssembly> assembly;
    for (int part = 0; part < parts; ++part)
    {
      const double x = 0.3 * part, z = 1.0 + 0.2 * part;
      const auto plane = planeOf({ x - 1.0, -1.0, z }, { x + 0.1, -0.9, z }, { x - 1.1, 0.8, z });
      vtkNew<vtkPolyData> empty;
      assembly->AddPart(actorOf(mapperOf(has(part) ? outputOf(plane).Get() : empty.Get())));
    }
    view.renderer->AddViewProp(assembly);
  };
  add(this->scene_.shared(), [&](int part) { return part % (this->last_ + 1) == this->own_; });
  add(this->scene_.alone(), [](int) { return true; });
  this->scene_.smooth("16");
  EXPECT_GT(this->scene_.expectSame(), 0u);
  EXPECT_GT(this->scene_.mixedPixels(), 0u);
}

TEST_F(SharedFrames, TellAllWhyOneFailed)
{
  this->failNext();
  this->scene_.shared().draw();
  EXPECT_EQ(this->scene_.shared().report().route, "none");
  const std::string error = this->takeError();
  EXPECT_THAT(error, testing::HasSubstr(FailingActor::error));
  if (this->own_ != this->last_)
  {
    EXPECT_THAT(error,
      testing::HasSubstr("process " + std::to_string(this->last_) + " of " +
        std::to_string(this->last_ + 1) + " failed"));
  }
  this->failNext();
  this->scene_.shared().draw(); // said once
  this->scene_.expectSame();
}

TEST_F(SharedFrames, RefuseDifferentLights)
{
  lightOf(this->scene_.shared().renderer)->SetPosition(1.0, 2.0, 10.0 + this->own_);
  this->scene_.shared().draw();
  EXPECT_EQ(this->scene_.shared().report().route, "none");
  EXPECT_THAT(this->takeError(), testing::HasSubstr("the processes have different lights"));
}

TEST_F(SharedFrames, TraceInPlaceOfOtherTechniques)
{
  this->scene_.shared().pass->SetTechnique("auto");
  this->scene_.expectSame();
  EXPECT_EQ(this->scene_.shared().report().lights.front().technique, "raytraced");
  this->scene_.shared().pass->SetTechnique("nsm");
  this->scene_.expectSame();
  EXPECT_THAT(this->takeError(),
    testing::HasSubstr("'nsm' sees the casters of one process, and several draw this picture"));
}

TEST_F(SharedFrames, TraceInPlaceOfRefusedTechniques)
{
  this->scene_.shared().pass->SetSetting("light_radius", "1");
  this->scene_.shared().pass->SetSetting("light_sampling", "jittered");
  this->scene_.shared().pass->SetSetting("light_samples", "5"); // no square
  this->scene_.shared().draw();
  EXPECT_EQ(this->scene_.shared().report().lights.front().technique, "raytraced");
  EXPECT_THAT(this->takeError(), testing::HasSubstr("It uses 'raytraced' instead"));
}

TEST_F(SharedFrames, HaveAllSamplesAtOnce)
{
  this->scene_.change(softened("2", "64"));
  this->scene_.change([](vtkRenderer* renderer) { set(lightOf(renderer), "moving_samples", "4"); });
  this->scene_.shared().draw();
  this->showOwn(
    this->own_ != this->last_); // one process's visibility is stale, the others' are not
  this->scene_.shared().draw();
  this->scene_.shared().draw();
  this->showOwn(true);
  this->scene_.shared().draw();
  EXPECT_EQ(this->scene_.shared().report().lights.front().progress, 1.0);
}

TEST_F(SharedFrames, KeepVisibilityIfOneAsks)
{
  this->scene_.shared().pass->SetKeepVisibility(this->own_ == 0);
  this->scene_.shared().draw();
  EXPECT_FALSE(this->scene_.shared().pass->GetVisibility().visibility.empty());
  this->scene_.change([](vtkRenderer* renderer) { lightOf(renderer)->SwitchOff(); });
  this->scene_.shared().draw();
  EXPECT_FALSE(this->scene_.shared().pass->GetVisibility().coverage.empty());
}

TEST_F(SharedFrames, CountSurfacesOfOthers)
{
  this->scene_.shared().pass->SetMeasureStages(this->own_ == 0);
  this->scene_.shared().draw();
  EXPECT_FALSE(this->scene_.shared().report().stages.empty());
  // Here nothing composites: each process shows its own part, as the pass drew it.
  EXPECT_LE(this->scene_.shared().report().otherSurfaces, 2);
  this->failNext();
  this->scene_.turnCamera(5.0);
  this->scene_.shared().draw();
  this->takeError();
  this->scene_.expectSame();
}

TEST_F(SharedFrames, EndWithTheController)
{
  this->scene_.expectSame();
  if (this->own_ == 0)
  {
    this->scene_.shared().pass->SetController(nullptr);
    this->scene_.shared().draw(); // the others need not know
    EXPECT_EQ(this->scene_.shared().report().processes, 1);
    EXPECT_EQ(this->scene_.shared().report().receiversDrawn, 1);
    this->scene_.shared().pass->SetController(controller());
  }
  this->scene_.expectSame();
}

TEST_F(SharedFrames, SurviveChangesByChance)
{
  std::mt19937 random(7); // the same on all processes
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int frame = 0; frame < 60; ++frame)
  {
    const double a = number(random);
    const double b = number(random);
    const int change = static_cast<int>(random() % 6);
    const bool mine = static_cast<int>(random() % 3) == this->own_;
    if (change == 5)
    {
      this->showOwn(!mine); // one process's part comes and goes
    }
    this->scene_.change(
      [&](vtkRenderer* renderer)
      {
        vtkLight* const light = lightOf(renderer);
        switch (change)
        {
          case 0:
            renderer->GetActiveCamera()->Azimuth(30.0 * a);
            break;
          case 1:
            light->SetPosition(10.0 * a, 10.0 * b, 12.0);
            break;
          case 2:
            light->SetPositional(a > 0.0);
            break;
          case 3:
            renderer->GetActors()->GetLastActor()->SetPosition(a, b, 0.0);
            break;
          case 4:
            light->SetIntensity(a > -0.5 ? 1.0 : 0.0);
            break;
          default:
            break;
        }
      });
    this->scene_.shared().draw();
    ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
  this->showOwn(true);
  this->scene_.change([](vtkRenderer* renderer) { lightOf(renderer)->SetIntensity(1.0); });
  this->scene_.expectSame();
}

} // namespace
} // namespace gnomon::test
