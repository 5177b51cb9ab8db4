// The pass's own settings, windows of any shape, and viewports that are a part of them.

#include "PassScene.h"

#include "plugin/vtkGnomonLightSamplingPass.h"

#include <set>

using namespace gnomon::test;
using testing::HasSubstr;

namespace
{

struct Settings : PassTest
{
  SphereUnderSun scene{ 200, 150 };
};

struct SettingsOfWay : PassTestOf<Way, Settings>
{
  SettingsOfWay() { this->scene.choose(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Ways, SettingsOfWay, allWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnPlanes, SettingsOfWay, testing::Values(planarWay), nameOf);

} // namespace

TEST_F(Settings, thatATechniqueLacksAreOneErrorEachAndShadowsStay)
{
  const Picture shadowed = this->scene.render("pcf");
  this->scene.pass->SetSetting("map_samples", "4");
  set(this->scene.sun, "contour", "6");
  for (int frame = 0; frame < 3; ++frame)
  {
    EXPECT_EQ(differingPixels(shadowed, this->scene.render()), 0u);
    EXPECT_EQ(this->scene.report().misfits.size(), 2u);
  }
  const std::string errors = this->takeErrors();
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 2) << errors;
  EXPECT_THAT(errors, HasSubstr("the setting 'map_samples' is for: "));
  EXPECT_THAT(errors,
    HasSubstr("light 0 has the technique 'pcf', and the setting 'contour' is for: selective."));
  // A setting for another technique is no error, and takes effect with that technique.
  this->scene.pass->SetTechnique("vsm");
  set(this->scene.sun, "contour", "");
  this->scene.render();
  EXPECT_EQ(this->scene.report().lights[0].mapSamples, 4);
  this->scene.render("nsm");
  EXPECT_TRUE(this->scene.report().misfits.empty());
}

TEST_F(Settings, anEmptyEstimatorIsTheTechniquesOwnAgain)
{
  this->scene.pass->SetSetting("estimator", "pcf");
  this->scene.render();
  EXPECT_EQ(this->scene.report().lights[0].estimator, "pcf");
  this->scene.pass->SetSetting("estimator", "");
  this->scene.render();
  EXPECT_EQ(this->scene.report().lights[0].estimator, "compare");
  this->scene.pass->SetSetting("estimator", "magic");
  EXPECT_THAT(this->takeErrors(), HasSubstr("one of: adaptive, compare, pcf, "));
}

TEST_F(Settings, techniquesAreListed)
{
  ASSERT_GE(vtkGnomonShadowPass::GetNumberOfTechniques(), 2);
  vtkNew<vtkGnomonShadowPass> pass;
  for (int i = 0; i < vtkGnomonShadowPass::GetNumberOfTechniques(); ++i)
  {
    pass->SetTechnique(vtkGnomonShadowPass::GetTechniqueName(i));
    EXPECT_STREQ(pass->GetTechnique(), vtkGnomonShadowPass::GetTechniqueName(i));
    EXPECT_STRNE(vtkGnomonShadowPass::GetTechniqueSummary(i), "");
  }
  EXPECT_EQ(vtkGnomonShadowPass::GetTechniqueName(-1), nullptr);
  EXPECT_EQ(
    vtkGnomonShadowPass::GetTechniqueName(vtkGnomonShadowPass::GetNumberOfTechniques()), nullptr);
}

TEST_P(SettingsOfWay, useShadowsIsTheSwitchWhereItIsObeyedAndBringsNoneOfVtks)
{
  EXPECT_FALSE(this->scene.pass->GetObeyUseShadows());
  const Picture shadowed = this->scene.render();
  this->scene.renderer->UseShadowsOn();
  const vtkMTimeType time = this->scene.renderer->GetMTime();
  for (const bool obeys : { false, true })
  {
    this->scene.pass->SetObeyUseShadows(obeys);
    EXPECT_EQ(differingPixels(shadowed, this->scene.render()), 0u);
    EXPECT_EQ(this->scene.renderer->GetUseShadows(), 1);
    EXPECT_EQ(this->scene.renderer->GetMTime(), time);
  }
  this->scene.renderer->UseShadowsOff();
  const Picture unshadowed = this->scene.render();
  EXPECT_EQ(this->scene.report().route, "none");
  EXPECT_THAT(this->scene.report().routeReason, HasSubstr("UseShadows"));
  EXPECT_EQ(differingPixels(unshadowed, this->scene.renderPlain()), 0u);
  EXPECT_GT(differingPixels(shadowed, unshadowed), 300u);
  this->scene.renderer->UseShadowsOn();
  vtkGnomonLightKeys::SetCasts(this->scene.sun, false);
  EXPECT_EQ(differingPixels(unshadowed, this->scene.render()), 0u);
}

TEST_P(SettingsOfWay, windowsOfOnePixel)
{
  for (const std::array<int, 2>& size :
    { std::array<int, 2>{ { 1, 1 } }, { { 1, 40 } }, { { 40, 1 } } })
  {
    SphereUnderSun scene(size[0], size[1]);
    scene.choose(GetParam());
    EXPECT_EQ(drawKept(scene).width, size[0]);
    EXPECT_EQ(scene.pass->GetVisibility().height, size[1]);
  }
}

/// The halves of one window equal the pictures of separate windows.
TEST_P(SettingsOfWay, onePassForTwoRenderersSideBySide)
{
  PassScene& left = this->scene;
  PassScene right(200, 150);
  right.addFloor(4.0);
  right.addBox({ -1.0, -1.0, 0.0 }, { 0.0, 0.0, 2.0 });
  vtkLight* const rightSun = right.addSun({ -1.0, 0.3, -1.5 });
  right.lookFrom({ 0.0, -9.0, 7.0 });
  right.choose(GetParam());
  const Picture expectedLeft = left.render();
  const Picture expectedRight = right.render();

  right.renderer->SetPass(left.pass);
  const auto window = gnomon::makeOffScreenWindow();
  window->SetSize(400, 150);
  left.window->RemoveRenderer(left.renderer);
  right.window->RemoveRenderer(right.renderer);
  left.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  right.renderer->SetViewport(0.5, 0.0, 1.0, 1.0);
  window->AddRenderer(left.renderer);
  window->AddRenderer(right.renderer);
  for (int frame = 0; frame < 3; ++frame)
  {
    // The two renderers share VTK's programs. Without this call, VTK 9.1 leaves one renderer's
    // lights in them for the other, with or without the pass.
    this->scene.sun->Modified();
    rightSun->Modified();
    window->Render();
    const Picture both = readPicture(window);
    const auto differs = [&](int x, int y)
    { return both.at(x, y) != (x < 200 ? expectedLeft.at(x, y) : expectedRight.at(x - 200, y)); };
    const std::size_t different = countPixels(both, differs);
    EXPECT_EQ(different, 0u) << "frame " << frame;
  }
}

namespace
{

const std::set<std::string> tracedOnTheCpu{ "raytraced", "silhouette", "crsm", "crsma",
  "penumbra" };

/// Runs with a Mesa that claims OpenGL 3.2, one 3.3 and one 4.1 (CMakeLists.txt).
struct OldOpenGL : PassTest
{
  OldOpenGL()
  {
    this->scene.lookDown(5.0, 1.0);
    this->scene.usePlain();
    this->scene.window->Render();
    this->scene.window->MakeCurrent();
    this->scene.window->GetOpenGLVersion(this->version.first, this->version.second);
  }

  void SetUp() override
  {
    if (this->version >= std::pair(4, 3))
    {
      GTEST_SKIP() << "this driver gives OpenGL 4.3 and more";
    }
    this->scene.useGnomon();
  }

  /// Draw by both routes, and expect the known shadow.
  void expectShadow(const char* technique, const char* taken)
  {
    SCOPED_TRACE(technique);
    this->scene.pass->SetTechnique(technique);
    for (const int route : { vtkGnomonShadowPass::ROUTE_IMAGE, vtkGnomonShadowPass::ROUTE_AUTO })
    {
      this->scene.pass->SetRoute(route);
      for (int frame = 0; frame < 3; ++frame)
      {
        expectRight(this->scene.check(this->scene.render(), 0.1), 10000);
        EXPECT_EQ(this->scene.report().lights.at(0).technique, taken);
      }
    }
  }

  BoxScene scene{ 200, 150, hangingBox, 10.0 };
  std::pair<int, int> version;
};

} // namespace

/// Techniques traced on the CPU show the known shadow. Lights with other techniques get
/// `raytraced`, which is reported once.
TEST_F(OldOpenGL, showsWhatTheCpuTraces)
{
  for (const std::string& technique : tracedOnTheCpu)
  {
    this->expectShadow(technique.c_str(), technique.c_str());
    EXPECT_EQ(this->takeErrors(), "") << technique;
  }
  for (const char* bake : { "always", "settled" })
  {
    this->scene.pass->SetSetting("bake", bake);
    this->scene.pass->SetSetting("edge_samples", "16");
    this->expectShadow("silhouette", "silhouette");
    EXPECT_EQ(this->takeErrors(), "") << bake;
  }
  set(this->scene.sun, "light_radius", "1");
  this->scene.render("edge_samples=1 penumbra");
  EXPECT_EQ(this->takeErrors(), "") << "an area light";
  EXPECT_EQ(this->scene.report().lights.at(0).lightSamples, 64);
}

TEST_F(OldOpenGL, hasRaysInPlaceOfWhatItCannotDraw)
{
  for (int i = 0; i < vtkGnomonShadowPass::GetNumberOfTechniques(); ++i)
  {
    const char* const technique = vtkGnomonShadowPass::GetTechniqueName(i);
    if (tracedOnTheCpu.count(technique) > 0)
    {
      continue;
    }
    this->expectShadow(technique, "raytraced");
    const std::string errors = this->takeErrors();
    EXPECT_THAT(errors, HasSubstr("needs OpenGL 4.3")) << technique;
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << "said once";
  }
}

TEST_F(OldOpenGL, hasNoMapsForTranslucentReceivers)
{
  this->scene.pass->SetTechnique("raytraced");
  this->scene.renderer->GetActors()->GetLastActor()->GetProperty()->SetOpacity(0.5);
  this->scene.render();
  EXPECT_THAT(this->scene.report().notes, testing::Contains(HasSubstr("take OpenGL 4.3")));
  EXPECT_EQ(this->takeErrors(), "");
}

TEST_F(OldOpenGL, isOneClearErrorOfLightSampling)
{
  this->scene.usePlain();
  const Picture plain = this->scene.render();
  vtkNew<vtkGnomonLightSamplingPass> sampling;
  set(this->scene.sun, "light_radius", "2");
  this->scene.renderer->SetPass(sampling);
  EXPECT_EQ(differingPixels(plain, this->scene.render()), 0u);
  EXPECT_EQ(differingPixels(plain, this->scene.render()), 0u);
  const std::string errorsOfSampling = this->takeErrors();
  EXPECT_THAT(errorsOfSampling, HasSubstr("OpenGL 4.3"));
  EXPECT_EQ(std::count(errorsOfSampling.begin(), errorsOfSampling.end(), '\n'), 1) << "one error";
  EXPECT_EQ(sampling->GetProgress(), 1.0) << "there is nothing to wait for";
}
