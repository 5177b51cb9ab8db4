// A fault of a frame is said once, and again after it was mended.

#include "PassScene.h"

#include "plugin/pass/Complaints.h"

#include <vtkRenderStepsPass.h>
#include <vtkSSAAPass.h>

namespace gnomon::test
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Something wrong that a user can do, and how it is put right.
struct Misuse
{
  const char* name;
  std::function<void(PassScene&)> make;
  std::function<void(PassScene&)> mend;
  const char* text; ///< a part of what is said
};

vtkActor* firstActor(PassScene& scene)
{
  return scene.renderer->GetActors()->GetLastActor();
}

void shadeFiner(PassScene& scene)
{
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAAPass> finer;
  finer->SetDelegatePass(steps);
  scene.pass->SetDelegatePass(finer);
}

struct ComplaintsOf : PassTestOf<Misuse>
{
  /// Draws frames and returns what is said of them.
  std::string said(PassScene& scene, int frames)
  {
    const std::size_t before = this->messages_.warnings().size();
    for (int frame = 0; frame < frames; ++frame)
    {
      scene.render();
    }
    std::string text = this->takeErrors();
    for (std::size_t i = before; i < this->messages_.warnings().size(); ++i)
    {
      text += this->messages_.warnings()[i] + "\n";
    }
    return text;
  }
};

} // namespace

INSTANTIATE_TEST_SUITE_P(All, ComplaintsOf,
  testing::Values(
    Misuse{ "inlineRoute",
      [](PassScene& scene) { scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_INLINE); },
      [](PassScene& scene) { scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_AUTO); },
      "inline route was asked for" },
    Misuse{ "deferredRoute",
      [](PassScene& scene)
      {
        scene.pass->SetTechnique("nsm");
        scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_DEFERRED);
      },
      [](PassScene& scene) { scene.pass->SetTechnique("raytraced"); },
      "deferred route was asked for" },
    Misuse{ "setting", [](PassScene& scene) { scene.choose("nsm kernel_size=3"); },
      [](PassScene& scene) { scene.pass->SetTechnique("pcf"); }, "kernel_size" },
    Misuse{ "headlight",
      [](PassScene& scene) { lightOf(scene.renderer)->SetLightTypeToHeadlight(); },
      [](PassScene& scene) { lightOf(scene.renderer)->SetLightTypeToSceneLight(); },
      "only light is a headlight" },
    Misuse{ "leftOut",
      [](PassScene& scene) { firstActor(scene)->GetProperty()->SetRepresentationToWireframe(); },
      [](PassScene& scene) { firstActor(scene)->GetProperty()->SetRepresentationToSurface(); },
      "as a wireframe" },
    Misuse{ "resolution", shadeFiner,
      [](PassScene& scene) { scene.pass->SetDelegatePass(nullptr); },
      "shades at another resolution" }),
  byName);

TEST_P(ComplaintsOf, misuseIsSaidOnceUntilItIsMended)
{
  PassScene scene(60, 40);
  scene.addFloor(4.0);
  scene.addBox({ -1.0, -1.0, 1.0 }, { 1.0, 1.0, 2.0 });
  scene.addSun({ 0.4, 0.3, -1.0 });
  scene.lookDown(4.0);
  scene.pass->SetTechnique("raytraced");
  EXPECT_EQ(this->said(scene, 2), "");
  for (int time = 0; time < 2; ++time)
  {
    GetParam().make(scene);
    const std::string text = this->said(scene, 3);
    EXPECT_THAT(text, HasSubstr(GetParam().text));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    GetParam().mend(scene);
    EXPECT_EQ(this->said(scene, 2), "");
  }
}

TEST(ComplaintsTest, textsThatStandAreNoNews)
{
  Complaints complaints;
  vtkNew<vtkRenderer> a;
  const auto news = [&](vtkRenderer* renderer, const std::vector<std::string>& texts)
  { return complaints.news(renderer, Topic::Lights, texts); };
  EXPECT_THAT(news(a, { "dim", "far" }), ElementsAre("dim", "far"));
  EXPECT_THAT(news(a, { "far", "odd" }), ElementsAre("odd"));
  EXPECT_THAT(news(a, { "dim" }), ElementsAre("dim")) << "it was mended in between";
  EXPECT_EQ(complaints.news(a, Topic::Route, std::string("dim")), "dim") << "another topic";
  EXPECT_THAT(news(a, { "dim" }), IsEmpty());
}

/// Frames of several renderers alternate: what is true of one of them stands.
TEST(ComplaintsTest, renderersShareWhatIsSaid)
{
  Complaints complaints;
  vtkNew<vtkRenderer> a;
  auto b = vtkSmartPointer<vtkRenderer>::New();
  const auto isNews = [&](vtkRenderer* renderer, const std::string& text)
  { return !complaints.news(renderer, Topic::Route, text).empty(); };
  EXPECT_TRUE(isNews(a, "dim"));
  EXPECT_FALSE(isNews(b, ""));
  EXPECT_FALSE(isNews(a, "dim"));
  EXPECT_FALSE(isNews(b, "dim"));
  EXPECT_FALSE(isNews(a, ""));
  EXPECT_FALSE(isNews(a, "dim")) << "it stands for the other one";
  EXPECT_FALSE(isNews(a, ""));
  b = nullptr;
  EXPECT_TRUE(isNews(a, "dim")) << "which is gone";
}

} // namespace gnomon::test
