// Pictures from many points of a light, which may take several frames: they end with what one frame
// would show, and restart when something changes. Also the memory and uniforms of `sampled`.

#include "AreaLights.h"

#include "plugin/vtkGnomonLightSamplingPass.h"
#include "shadowtech/base/Gl.h"
#include "vtkGnomonShadowSettings.h"

#include <vtkCollectionRange.h>
#include <vtkCommand.h>
#include <vtkHardwareSelector.h>
#include <vtkLookupTable.h>
#include <vtkScalarBarActor.h>
#include <vtkSelection.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

namespace gnomon::test
{
namespace
{

/// A way to add samples of a light from frame to frame.
struct Refiner
{
  const char* name;
  const char* technique;
  const char* setting; ///< of the pass; null for vtkGnomonLightSamplingPass
  bool startsHard;     ///< true if the first frame shows the centre's shadow, by `nsm`
};
const Refiner refiners[] = { { "sampled", "sampled", "progressive", true },
  { "raytraced", "raytraced", "moving_samples", false },
  { "penumbra", "penumbra", "moving_samples", false }, { "lightSampling", "nsm", nullptr, true } };

struct Refining : PassTestOf<Refiner>
{
  Refining()
  {
    this->scene.addThings();
    this->scene.pass->SetTechnique(GetParam().technique);
    this->sampling->SetDelegatePass(this->scene.pass);
    this->scene.renderer->SetPass(this->sampling);
    if (GetParam().setting)
    {
      this->scene.useGnomon();
    }
    this->takeSamples(64);
    this->takeEachFrame(16);
  }

  bool isSampling() const { return !GetParam().setting; }
  void takeSamples(int samples)
  {
    this->sampling->SetSamples(samples);
    this->isSampling() ? void() : this->scene.set("light_samples", samples);
  }
  /// @param samples 0 for all of them
  void takeEachFrame(int samples)
  {
    this->sampling->SetSamplesPerFrame(samples);
    this->isSampling() ? void() : this->scene.set(GetParam().setting, samples);
  }
  double progress() const
  {
    return this->isSampling() ? this->sampling->GetProgress() : this->scene.pass->GetProgress();
  }
  void finish()
  {
    int frame = 0;
    do
    {
      this->scene.render();
      ASSERT_LT(frame++, 20);
    } while (this->progress() < 1.0);
  }

  PassScene scene{ 140, 100 };
  vtkGnomonAreaLight* light =
    addRectangle(this->scene, { -2.0, -2.5, 6.0 }, glm::dvec3(0.0), 1.5, 50.0);
  vtkNew<vtkGnomonLightSamplingPass> sampling;
};
INSTANTIATE_TEST_SUITE_P(All, Refining, testing::ValuesIn(refiners), byName);

/// The part of a frame that a change concerns.
enum class Concern
{
  Shadow,
  Picture, ///< which vtkGnomonLightSamplingPass draws again from each point of the light
  Material ///< of which others may draw receivers again
};
struct Change
{
  const char* what;
  std::function<void()> apply;
  Concern concern = Concern::Shadow;
};

} // namespace

TEST_P(Refining, endsWithWhatOneFrameShows)
{
  for (const int samples : { 64, 65 })
  {
    this->takeSamples(samples);
    this->takeEachFrame(0);
    const Picture whole = this->scene.render();
    EXPECT_EQ(this->progress(), 1.0);
    this->scene.pass->SetTechnique("nsm");
    this->scene.useGnomon();
    const Picture hard = this->scene.render();
    this->scene.pass->SetTechnique(GetParam().technique);
    this->isSampling() ? this->scene.renderer->SetPass(this->sampling) : void();
    this->takeEachFrame(16);
    const Picture first = this->scene.render();
    EXPECT_EQ(differingPixels(first, hard) == 0, GetParam().startsHard);
    EXPECT_EQ(this->progress() == 0.0, GetParam().startsHard);
    std::size_t farther = differingPixels(first, whole, 8) + 1;
    double before = -1.0;
    for (int frame = 1; this->progress() < 1.0; ++frame)
    {
      ASSERT_LT(frame, 10);
      EXPECT_GT(this->progress(), before);
      before = this->progress();
      const std::size_t different = differingPixels(this->scene.render(), whole, 8);
      EXPECT_LT(different, farther);
      farther = different + 1;
    }
    EXPECT_TRUE(this->scene.render() == whole);
    EXPECT_TRUE(
      this->isSampling() || this->scene.report().mapBakes + this->scene.report().raysTraced == 0)
      << "at rest";
  }
}

TEST_P(Refining, restartsOnceWhenSomethingChanges)
{
  vtkActor* box = this->scene.addBox({ 1.0, -2.0, 0.0 }, { 1.5, -1.5, 1.0 });
  vtkActor* outOfView = this->scene.addBox({ -2.2, -3.0, 3.0 }, { -1.8, -2.6, 3.1 });
  vtkNew<vtkTextActor> text;
  text->SetInput("3");
  this->scene.renderer->AddViewProp(text);
  vtkNew<vtkLookupTable> table;
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  this->scene.renderer->AddViewProp(bar);
  const auto colour = makeImage(1, 1, [](int, int) { return glm::dvec3(0.5); });
  const auto sky = textureOf(colour);
  vtkNew<vtkGnomonShadowSettings> settings;
  vtkNew<vtkLight> other;
  other->SetIntensity(0.1);
  this->scene.pass->ObeyUseShadowsOn();
  this->scene.renderer->UseShadowsOn();
  const Change changes[] = {
    { "camera",
      [&] {
        this->scene.lookFrom({ 2.1, -8.0, 7.0 });
      } },
    { "light", [&] { this->light->SetPosition(-2.0, -2.6, 6.0); } },
    { "size", [&] { this->light->SetWidth(1.3); } },
    { "cone", [&] { this->light->SetConeAngle(45.0); } },
    { "shape", [&] { this->light->SetShapeToDisk(); } },
    { "caster", [&] { box->SetPosition(0.1, 0.0, 0.0); } },
    { "caster out of view", [&] { outOfView->SetPosition(0.1, 0.1, 0.0); } },
    { "casting", [&] { vtkGnomonPropKeys::SetCasts(box, false); } },
    { "receiving", [&] { vtkGnomonPropKeys::SetReceives(box, false); } },
    { "visible", [&] { box->VisibilityOff(); } },
    { "samples", [&] { this->takeSamples(48); } },
    { "seed", [&] { set(this->light, "light_seed", "3"); } },
    { "window", [&] { this->scene.window->SetSize(120, 90); } },
    { "texture", [&] { this->light->SetTexture(colour); } },
    { "its texels",
      [&]
      {
        colour->SetScalarComponentFromDouble(0, 0, 0, 0, 200.0);
        colour->GetPointData()->GetScalars()->Modified();
      } },
    { "colour", [&] { this->light->SetDiffuseColor(1.0, 0.9, 0.8); }, Concern::Picture },
    { "material", [&] { outOfView->GetProperty()->SetSpecular(0.3); }, Concern::Material },
    { "text", [&] { text->SetInput("4"); }, Concern::Picture },
    { "scalar bar's table", [&] { table->SetHueRange(0.2, 0.4); }, Concern::Picture },
    { "scalar bar's text", [&] { bar->GetLabelTextProperty()->SetOpacity(0.5); },
      Concern::Picture },
    { "background", [&] { this->scene.renderer->SetBackground(0.1, 0.2, 0.3); }, Concern::Picture },
    { "background's texture",
      [&]
      {
        this->scene.renderer->SetBackgroundTexture(sky);
        this->scene.renderer->TexturedBackgroundOn();
      },
      Concern::Picture },
    { "its pixels",
      [&]
      {
        colour->SetScalarComponentFromDouble(0, 0, 0, 0, 100.0);
        colour->Modified();
      } },
    { "light's settings",
      [&]
      {
        set(this->light, "light_seed", nullptr);
        vtkGnomonLightKeys::SetSettings(this->light, settings);
      } },
    { "one of them",
      [&] { this->isSampling() ? settings->SetMapSize(300) : settings->SetLightSeed(5); } },
    { "another light", [&] { this->scene.renderer->AddLight(other); }, Concern::Material },
    { "no other light", [&] { this->scene.renderer->RemoveLight(other); }, Concern::Material },
    { "samples of a pixel", [&] { this->scene.window->SetMultiSamples(4); }, Concern::Material },
    { "pass's settings",
      [&] { this->isSampling() ? this->scene.pass->GetSettings()->SetMapSize(200) : void(); },
      Concern::Material },
    { "technique", [&] { this->isSampling() ? this->scene.choose("pcf") : void(); },
      Concern::Material },
    { "shadows", [&] { this->scene.renderer->UseShadowsOff(); }, Concern::Material },
    { "delegate", [&] { this->sampling->SetDelegatePass(nullptr); }, Concern::Material },
  };
  for (const Change& change : changes)
  {
    SCOPED_TRACE(change.what);
    this->finish();
    change.apply();
    this->scene.render();
    const bool restarts = change.concern == Concern::Shadow || this->isSampling();
    const double first = this->progress();
    this->scene.render();
    if (restarts || change.concern == Concern::Picture)
    {
      EXPECT_EQ(first < 1.0, restarts);
      EXPECT_EQ(this->progress() > first, restarts);
    }
  }
}

TEST_P(Refining, tellsOfItsProgress)
{
  constexpr double end = 2.0;
  std::vector<double> told;
  vtkRenderPass* const teller = this->scene.renderer->GetPass();
  onEvent(teller, vtkCommand::ProgressEvent,
    [&](void* progress) { told.push_back(*static_cast<double*>(progress)); });
  onEvent(teller, vtkCommand::EndEvent, [&](void*) { told.push_back(end); });
  this->takeEachFrame(0);
  this->scene.render();
  EXPECT_TRUE(told.empty()) << "in one frame";
  this->takeEachFrame(16);
  this->light->SetWidth(1.4);
  this->scene.render();
  this->light->SetWidth(1.3); // before the refinement ends
  this->finish();
  this->scene.render();
  const double step = this->isSampling() || GetParam().startsHard ? 0.0 : 0.25;
  ASSERT_GE(told.size(), 4u);
  EXPECT_EQ(told[0], step);
  EXPECT_EQ(told[1], step) << "again";
  EXPECT_TRUE(std::is_sorted(told.begin() + 1, told.end()));
  EXPECT_EQ(told[told.size() - 2], 1.0);
  EXPECT_EQ(told.back(), end);
  EXPECT_EQ(std::count(told.begin(), told.end(), end), 1);
}

TEST_P(Refining, goesOnAcrossSelections)
{
  double before = -1.0;
  for (int frame = 0; this->progress() < 1.0 || frame == 0; ++frame)
  {
    ASSERT_LT(frame, 10);
    this->scene.render();
    EXPECT_GT(this->progress(), before);
    before = this->progress();
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(this->scene.renderer);
    selector->SetArea(0, 0, 139, 99);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    EXPECT_EQ(selection->GetNumberOfNodes(), 3u);
    EXPECT_EQ(this->progress(), before) << "after a selection";
  }
}

/// Views that the pass draws in turn would restart each other.
TEST_P(Refining, takesAllAtOnceWhereThePassDrawsSeveralViews)
{
  this->scene.render();
  EXPECT_LT(this->progress(), 1.0);
  vtkNew<vtkRenderer> other;
  other->SetPass(this->scene.renderer->GetPass());
  other->SetViewport(0.5, 0.0, 1.0, 1.0);
  other->SetActiveCamera(this->scene.renderer->GetActiveCamera());
  for (vtkActor* actor : vtk::Range(this->scene.renderer->GetActors()))
  {
    other->AddActor(actor);
  }
  other->AddLight(this->light);
  this->scene.window->AddRenderer(other);
  const auto expectAll = [&]
  {
    for (int frame = 0; frame < 3; ++frame)
    {
      this->scene.window->Render();
      EXPECT_EQ(this->progress(), 1.0);
    }
    const auto saysWhy = testing::Contains(testing::HasSubstr("renders several"));
    EXPECT_TRUE(testing::Value(this->scene.report().notes, saysWhy) ||
      GetParam().technique != refiners[0].technique);
  };
  expectAll();
  this->scene.window->RemoveRenderer(other);
  this->scene.window->StereoCapableWindowOn();
  this->scene.window->SetStereoTypeToAnaglyph();
  this->scene.window->StereoRenderOn();
  expectAll();
}

namespace
{

/// `sampled` under an area light.
struct Sampled : PassTest
{
  Sampled()
  {
    this->scene.addThings();
    this->scene.choose("sampled light_samples=32");
  }
  PassScene scene{ 140, 100 };
  vtkGnomonAreaLight* light = addDisk(this->scene, { -2.0, -2.5, 6.0 }, glm::dvec3(0.0), 0.5, 50.0);
};

struct Progressive : Sampled
{
  Progressive() { this->scene.choose("progressive=16"); }
};

} // namespace

/// The centre's map is reused for all cameras.
TEST_F(Progressive, staysHardWhileTheCameraMoves)
{
  this->scene.render();
  for (const double x : { 1.8, 1.5, 1.0 })
  {
    this->scene.lookFrom({ x, -8.0, 7.0 });
    const std::vector<float> seen = drawKept(this->scene).visibility[0];
    EXPECT_EQ(this->scene.report().mapBakes, 0) << x;
    EXPECT_EQ(countBetween(seen), 0u) << x;
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, 1) << x;
  }
}

TEST_F(Progressive, refinesEachLight)
{
  vtkLight* other = addSoftSun(this->scene, { -1.0, 0.5, -1.5 }, "5");
  set(other, "progressive", "8");
  for (const double progress : { 0.0, 0.25, 0.5, 0.75, 1.0, 1.0 })
  {
    this->scene.render();
    EXPECT_EQ(this->scene.pass->GetProgress(), progress);
  }
  other->SetIntensity(0.5);
  scaleArea(this->light, 0.8);
  this->scene.render();
  EXPECT_EQ(this->scene.report().lights[0].progress, 0.0);
  EXPECT_EQ(this->scene.report().lights[1].progress, 1.0) << "only a changed light restarts";
}

TEST_F(PassTest, jitteredSamplesAreRefinedBySquares)
{
  PassScene scene(140, 100);
  scene.addThings();
  addDisk(scene, { -2.0, -2.5, 6.0 }, glm::dvec3(0.0), 0.5, 50.0);
  scene.choose("raytraced light_sampling=jittered moving_samples=5");
  scene.window->Render();
  EXPECT_THAT(this->takeErrors(), testing::HasSubstr("'moving_samples' 5 is no square"));
  scene.set("moving_samples", 9);
  scene.window->Render();
  EXPECT_EQ(scene.report().lights[0].lightSamples, 9);
}

TEST_F(Sampled, takesBoundedMemory)
{
  const std::size_t map = 64 * 64 * 4;
  const std::size_t images = 2 * 140 * 100 * 4;
  this->scene.set("map_size", 64);
  const auto expectMaps = [&](std::size_t maps, int samples)
  {
    this->scene.set("light_samples", samples);
    this->scene.render();
    EXPECT_EQ(this->scene.report().bytesMaps, maps * map + images);
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, samples);
  };
  expectMaps(9, 64);
  expectMaps(9, 256);
  this->scene.set("batch", 2);
  expectMaps(3, 255);
}

/// OpenGL guarantees 1,024 uniform components, where hardware stores each array element as a vector
/// of four, and 16 textures. Nine lights that see all around must fit into these.
TEST_F(Sampled, batchesFitIntoTheUniformsThatOpenGlPromises)
{
  this->light->SetConeAngle(allDirections);
  this->light->SetPosition(0.3, -0.6, 1.5); // among the casters, so all faces see some
  this->light->SetShapeToRectangle();
  const auto image = makeImage(2, 2, [](int, int) { return glm::dvec3(0.8); });
  for (const bool textured : { false, true })
  {
    this->light->SetTexture(textured ? image.Get() : nullptr);
    this->scene.render();
    EXPECT_EQ(this->scene.report().mapBakes, textured ? 32 : 33);
    int programs = 0;
    for (GLuint program = 1; program < 1000; ++program)
    {
      if (!glIsProgram(program) || glGetUniformLocation(program, "batchShine") < 0)
      {
        continue;
      }
      ++programs;
      int components = 0;
      int textures = 0;
      GLint uniforms = 0;
      glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &uniforms);
      for (GLint i = 0; i < uniforms; ++i)
      {
        GLint size = 0;
        GLenum type = GL_NONE;
        GLchar name[64];
        glGetActiveUniform(
          program, static_cast<GLuint>(i), sizeof(name), nullptr, &size, &type, name);
        const bool isTexture = type == GL_SAMPLER_2D || type == GL_SAMPLER_2D_ARRAY;
        const int vectors = type == GL_FLOAT_MAT4 ? 4 : type == GL_FLOAT_MAT3 ? 3 : 1;
        textures += isTexture ? size : 0;
        components += isTexture ? 0 : 4 * vectors * size;
      }
      EXPECT_LE(components, 1024) << textured;
      EXPECT_LE(textures, 16) << textured;
      EXPECT_GT(components, 9 * 4 * (4 + 6)) << "all lights' matrices and views";
    }
    EXPECT_GE(programs, 1);
  }
}

} // namespace gnomon::test
