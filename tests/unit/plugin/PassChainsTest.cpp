// Other render passes around the shadow pass and inside it: the shadow must be where it is without
// them. docs/guide/passes.md lists these combinations.

#include "PassScene.h"

#include <vtkCameraPass.h>
#include <vtkDepthPeelingPass.h>
#include <vtkDualDepthPeelingPass.h>
#include <vtkEDLShading.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkPanoramicProjectionPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderStepsPass.h>
#include <vtkSSAAPass.h>
#include <vtkSSAOPass.h>
#include <vtkSequencePass.h>
#include <vtkToneMappingPass.h>
#include <vtkTranslucentPass.h>

using namespace gnomon::test;

namespace
{

using Pass = vtkSmartPointer<vtkRenderPass>;

template <typename OuterPass>
Pass around(vtkRenderPass* inner)
{
  auto outer = vtkSmartPointer<OuterPass>::New();
  outer->SetDelegatePass(inner);
  return outer;
}

Pass toneMapping(vtkRenderPass* inner)
{
  auto outer = vtkSmartPointer<vtkToneMappingPass>::New();
  outer->SetToneMappingType(vtkToneMappingPass::Clamp);
  outer->SetDelegatePass(inner);
  return outer;
}

/// Occlusion within half a unit: only what the box's faces do to each other.
Pass ambientOcclusion(vtkRenderPass* inner)
{
  auto outer = vtkSmartPointer<vtkSSAOPass>::New();
  outer->SetRadius(0.5);
  outer->SetDelegatePass(inner);
  return outer;
}

Pass cameraAndSequence(vtkRenderPass* inner)
{
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(inner);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  return around<vtkCameraPass>(sequence);
}

Pass steps()
{
  return vtkSmartPointer<vtkRenderStepsPass>::New();
}

template <typename Peeling>
Pass stepsPeeling()
{
  auto result = vtkSmartPointer<vtkRenderStepsPass>::New();
  vtkNew<Peeling> peeling;
  vtkNew<vtkTranslucentPass> translucent;
  peeling->SetTranslucentPass(translucent);
  result->SetTranslucentPass(peeling);
  return result;
}

/// Passes around the shadow pass (outer), and inside it (inner).
struct Chain
{
  const char* name;
  std::function<Pass(vtkRenderPass* shadows)> outer;
  std::function<Pass()> inner;
};

const std::vector<Chain>& chains()
{
  static const std::vector<Chain> all = {
    { "SSAA_shadows", around<vtkSSAAPass>, nullptr },
    { "SSAO_shadows", ambientOcclusion, nullptr },
    { "toneMapping_shadows", toneMapping, nullptr },
    { "FXAA_shadows", around<vtkOpenGLFXAAPass>, nullptr },
    { "camera_sequence_shadows", cameraAndSequence, nullptr },
    { "toneMapping_SSAA_shadows",
      [](vtkRenderPass* shadows) { return toneMapping(around<vtkSSAAPass>(shadows)); }, nullptr },
    { "shadows_steps", nullptr, steps },
    { "shadows_steps_peeling", nullptr, stepsPeeling<vtkDepthPeelingPass> },
    { "shadows_steps_dualPeeling", nullptr, stepsPeeling<vtkDualDepthPeelingPass> },
    { "shadows_SSAO_steps", nullptr, [] { return ambientOcclusion(steps()); } },
    { "shadows_toneMapping_steps", nullptr, [] { return toneMapping(steps()); } },
    { "shadows_FXAA_steps", nullptr, [] { return around<vtkOpenGLFXAAPass>(steps()); } },
    { "SSAA_shadows_steps", around<vtkSSAAPass>, steps },
    { "toneMapping_shadows_SSAO_steps", toneMapping, [] { return ambientOcclusion(steps()); } },
  };
  return all;
}

struct ChainedScene : PassTest
{
  ChainedScene() { this->scene.lookDown(10.0); }

  void useChain(const Chain& chain)
  {
    this->top_ = chain.outer ? chain.outer(this->scene.pass) : Pass(this->scene.pass);
    this->scene.pass->SetDelegatePass(chain.inner ? chain.inner() : nullptr);
    this->scene.renderer->SetPass(this->top_);
  }

  /// Floor pixels that are not as the sun and the box say.
  FloorCheck check(const Picture& picture) const
  {
    // Three texels, and what filters over pixels reach.
    return this->scene.check(picture, 3.0 * 24.0 / 1024.0 + 3.0 * 20.0 / 300.0);
  }

  BoxScene scene{ 300, 300, hangingBox, 10.0 };

private:
  Pass top_;
};

using PassChains = PassTestOf<std::tuple<std::size_t, Way>, ChainedScene>;

std::string nameOfChain(const testing::TestParamInfo<std::tuple<std::size_t, Way>>& info)
{
  return std::string(chains()[std::get<0>(info.param)].name) + "_" +
    nameOf(testing::TestParamInfo<Way>(std::get<1>(info.param), info.index));
}

INSTANTIATE_TEST_SUITE_P(All, PassChains,
  testing::Combine(testing::Range(std::size_t(0), chains().size()), allWays), nameOfChain);

} // namespace

TEST_P(PassChains, ShadowsAreWhereTheyAreAlone)
{
  this->useChain(chains()[std::get<0>(GetParam())]);
  this->scene.choose(std::get<1>(GetParam()));
  for (int frame = 0; frame < 2; ++frame)
  {
    expectRight(this->check(this->scene.render()), 60000);
  }
  EXPECT_EQ(this->scene.report().mapBakes, 0);
}

/// Without a casting light the chain draws what it draws without the shadow pass.
TEST_P(PassChains, WithoutShadowsTheyDrawTheSame)
{
  const Chain& chain = chains()[std::get<0>(GetParam())];
  this->scene.choose(std::get<1>(GetParam()));
  vtkActor* actor =
    this->scene.add(planeOf({ -3.0, -3.0, 5.0 }, { 2.0, -3.0, 5.0 }, { -3.0, 2.0, 5.0 }));
  actor->GetProperty()->SetOpacity(0.5);
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  lightOf(this->scene.renderer)->SetShadowAttenuation(0.0f);
  this->useChain(chain);
  const Picture with = this->scene.render();
  const Pass inside = chain.inner ? chain.inner() : steps();
  const Pass plain = chain.outer ? chain.outer(inside) : inside;
  this->scene.renderer->SetPass(plain);
  EXPECT_EQ(differingPixels(with, this->scene.render(), 1), 0u);
}

/// A pass that shades at another resolution inside the shadow pass: fine for functions of the
/// point, refused for what is per pixel.
TEST_F(ChainedScene, SupersamplingInsideIsForFunctionsOfThePoint)
{
  this->scene.pass->SetDelegatePass(around<vtkSSAAPass>(steps()));
  for (const Way& way : { Way{ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE },
         Way{ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE } })
  {
    this->scene.choose({ "nsm", vtkGnomonShadowPass::ROUTE_INLINE });
    EXPECT_EQ(this->check(this->scene.render()).wrong(), 0u);
    EXPECT_EQ(this->takeErrors(), "");

    const FloorCheck unshadowed = this->check(this->scene.render(way));
    EXPECT_THAT(this->takeErrors(),
      testing::AllOf(testing::HasSubstr("vtkSSAAPass"), testing::HasSubstr("resolution")));
    EXPECT_GT(unshadowed.falseLight, 500u);
    EXPECT_EQ(unshadowed.falseShadow, 0u);
  }
}

TEST_F(ChainedScene, PassesInsideWithCamerasOfTheirOwnAreRefused)
{
  const auto panorama = []
  {
    auto pass = vtkSmartPointer<vtkPanoramicProjectionPass>::New();
    pass->SetCubeResolution(256); // the window's size: no other resolution
    pass->SetDelegatePass(steps());
    return pass;
  };
  this->scene.window->SetSize(256, 256);
  this->scene.renderer->SetPass(panorama());
  const Picture plain = this->scene.render();
  this->scene.renderer->SetPass(this->scene.pass);
  for (const char* technique : { "nsm", "raytraced" })
  {
    this->scene.pass->SetTechnique(technique);
    this->scene.pass->SetDelegatePass(nullptr);
    this->scene.render(); // an error is said once until it is mended
    EXPECT_EQ(this->takeErrors(), "");
    this->scene.pass->SetDelegatePass(panorama());
    const Picture picture = this->scene.render();
    EXPECT_THAT(this->takeErrors(),
      testing::AllOf(testing::HasSubstr("vtkPanoramic"), testing::HasSubstr("another camera")));
    if (this->scene.report().route == "image")
    {
      EXPECT_EQ(differingPixels(picture, plain, 1), 0u);
    }
  }
}

TEST_F(ChainedScene, ReportSaysThatAnotherPassDrewSince)
{
  const auto namesOther = [this](const char* name)
  {
    return std::count_if(this->scene.report().notes.begin(), this->scene.report().notes.end(),
      [name](const std::string& note)
      { return note.find("since been drawn by " + std::string(name)) != std::string::npos; });
  };
  const Picture shadowed = this->scene.render();
  EXPECT_TRUE(this->scene.report().notes.empty());
  const std::vector<std::pair<const char*, Pass>> others = {
    { "vtkRenderStepsPass", vtkSmartPointer<vtkRenderStepsPass>::New() }, { "no pass", nullptr }
  };
  for (const auto& [name, pass] : others)
  {
    this->scene.renderer->SetPass(pass);
    for (int frame = 0; frame < 3; ++frame)
    {
      this->scene.render();
      EXPECT_EQ(namesOther(name), 1) << name;
      EXPECT_EQ(this->scene.report().lights.size(), 1u) << name;
    }
    this->scene.renderer->SetPass(this->scene.pass);
    EXPECT_EQ(differingPixels(this->scene.render(), shadowed), 0u);
    EXPECT_TRUE(this->scene.report().notes.empty());
  }
}
