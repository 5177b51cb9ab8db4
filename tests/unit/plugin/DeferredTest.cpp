// The deferred route draws the picture once, lit and in shadow, and visibility selects. It must
// equal the image route's picture to the byte.

#include "BuiltinPass.h"
#include "PassScene.h"

#include <vtkAnnotatedCubeActor.h>
#include <vtkAxesActor.h>
#include <vtkAxisActor.h>
#include <vtkAxisFollower.h>
#include <vtkImageProperty.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkImageStack.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPropAssembly.h>
#include <vtkRenderStepsPass.h>
#include <vtkShaderProperty.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

using namespace gnomon::test;
using testing::HasSubstr;

namespace
{

using DeferredScenes = PassTestOf<const char*>;

// Scenes with holes in textures, open sheets, a point light, and impostors of spheres and sticks.
INSTANTIATE_TEST_SUITE_P(Scenes, DeferredScenes,
  testing::Values("bunny", "screens", "posts", "cups", "room", "terrain", "molecule", "primitives"),
  byText);

/// A mapper of a class that Gnomon does not know, as one that draws in its own way.
class UnusualMapper : public vtkOpenGLPolyDataMapper
{
public:
  static UnusualMapper* New();
  vtkTypeMacro(UnusualMapper, vtkOpenGLPolyDataMapper);
};
vtkStandardNewMacro(UnusualMapper);

/// A sphere over a floor under a sun, which the deferred route can draw.
struct Deferred : PassTest
{
  Deferred() { this->scene.pass->SetTechnique("raytraced"); }

  Picture draw(int route)
  {
    this->scene.pass->SetRoute(route);
    return this->scene.render();
  }

  /// Draw by both routes, by the deferred one twice, with another camera in between.
  void expectTheSame(const std::string& what)
  {
    SCOPED_TRACE(what);
    const Picture image = this->draw(vtkGnomonShadowPass::ROUTE_IMAGE);
    EXPECT_EQ(this->scene.report().route, "image");
    const Picture deferred = this->draw(vtkGnomonShadowPass::ROUTE_AUTO);
    EXPECT_EQ(this->scene.report().route, "deferred") << this->scene.report().routeReason;
    EXPECT_EQ(differingPixels(image, deferred), 0u);
    EXPECT_EQ(differingPixels(image, this->scene.render()), 0u) << "nothing changed";
    this->scene.renderer->GetActiveCamera()->Azimuth(20.0);
    const Picture moved = this->scene.render();
    EXPECT_GT(differingPixels(image, moved), 100u);
    EXPECT_EQ(differingPixels(this->draw(vtkGnomonShadowPass::ROUTE_IMAGE), moved), 0u) << "moved";
    this->scene.renderer->GetActiveCamera()->Azimuth(-20.0);
  }

  /// Return the automatic route and its reason.
  std::string autoRoute()
  {
    this->draw(vtkGnomonShadowPass::ROUTE_AUTO);
    return this->scene.report().route;
  }

  SphereUnderSun scene{ 203, 157 }; ///< not a multiple of the tiles
};

} // namespace

TEST_P(DeferredScenes, showTheBytesOfTheImageRoute)
{
  const BuiltinPass scene(GetParam(), 400, 300);
  scene.pass->KeepVisibilityOff();
  scene.pass->SmoothTerminatorsOn();
  // Pixels between light and shadow may differ by one, as they mix bytes.
  scene.choose("edge_samples=1");
  const auto draw = [&](int route)
  {
    scene.pass->SetRoute(route);
    return scene.render();
  };
  std::size_t dark = 0;
  for (const char* technique : { "raytraced", "silhouette" })
  {
    scene.choose(technique);
    for (int view = 0; view < 3; ++view)
    {
      scene.renderer->GetActiveCamera()->Azimuth(7.0);
      const Picture deferred = draw(vtkGnomonShadowPass::ROUTE_AUTO);
      EXPECT_EQ(scene.report().route, "deferred") << scene.report().routeReason;
      EXPECT_EQ(differingPixels(draw(vtkGnomonShadowPass::ROUTE_IMAGE), deferred), 0u)
        << technique << ", view " << view;
      dark += differingPixels(scene.renderPlain(), deferred, 32);
    }
  }
  EXPECT_GT(dark, 500u) << "no shadow";
}

TEST_F(Deferred, OtherPropsThanOpaqueOnesComeAfterwards)
{
  this->scene.renderer->GradientBackgroundOn();
  this->scene.renderer->SetBackground2(0.2, 0.4, 0.9);
  this->expectTheSame("in front of a gradient");
  vtkActor* pane = this->scene.addFloor(1.0, 2.5);
  pane->GetProperty()->SetOpacity(0.5);
  this->expectTheSame("a pane that receives");
  this->scene.renderer->UseDepthPeelingOn();
  this->expectTheSame("by depth peeling");
  vtkNew<vtkTextActor> text;
  text->SetInput("text");
  this->scene.renderer->AddActor(text);
  this->expectTheSame("text on top");
  this->scene.renderer->UseFXAAOn();
  this->expectTheSame("smoothed");
}

TEST_F(Deferred, OtherFramesTakeTheImageRouteAndSayWhy)
{
  const auto expectReason = [&](const std::string& reason)
  {
    this->draw(vtkGnomonShadowPass::ROUTE_DEFERRED);
    EXPECT_EQ(this->scene.report().route, "image");
    EXPECT_THAT(this->scene.report().routeReason, HasSubstr(reason));
    EXPECT_THAT(this->takeErrors(), HasSubstr(reason));
    EXPECT_EQ(this->autoRoute(), "image");
  };
  this->draw(vtkGnomonShadowPass::ROUTE_DEFERRED);
  EXPECT_EQ(this->scene.report().route, "deferred");
  vtkLight* second = this->scene.addSun({ -1.0, 1.0, -1.0 });
  expectReason("2 lights");
  second->SwitchOff();
  this->scene.renderer->UseSSAOOn();
  expectReason("a render pass draws");
  this->scene.renderer->UseSSAOOff();
  vtkNew<vtkRenderStepsPass> steps;
  this->scene.pass->SetDelegatePass(steps);
  expectReason("a render pass draws");
  this->scene.pass->SetDelegatePass(nullptr);
  this->scene.sphere->GetShaderProperty()->AddFragmentShaderReplacement(
    "//VTK::Light::Impl", true, "//VTK::Light::Impl\n  gl_FragData[0].r *= 0.5;\n", false);
  expectReason("shaders of its own");
  this->scene.sphere->GetShaderProperty()->ClearAllFragmentShaderReplacements();
  const vtkSmartPointer<vtkMapper> usual = this->scene.sphere->GetMapper();
  vtkNew<UnusualMapper> unusual;
  unusual->SetInputConnection(usual->GetInputConnection(0, 0));
  this->scene.sphere->SetMapper(unusual);
  expectReason("shaders of its own");
  this->scene.sphere->SetMapper(usual);
  EXPECT_EQ(this->autoRoute(), "deferred");

  this->scene.pass->SetSetting("light_radius", "0.1");
  expectReason("between light and shadow");
  this->scene.choose("light_radius=0 nsm");
  this->draw(vtkGnomonShadowPass::ROUTE_DEFERRED);
  EXPECT_THAT(this->takeErrors(), HasSubstr("between light and shadow"));
  EXPECT_EQ(this->autoRoute(), "inline");
}

/// Annotations' parts have their own shaders, without shadows. In front of a shadow they are as
/// bright as VTK draws them; behind other surfaces they are hidden.
TEST_F(Deferred, PropsThatPassesDoNotReachAreAsVtkDrawsThem)
{
  vtkNew<vtkAnnotatedCubeActor> cube;
  cube->SetPosition(1.5, 0.9, 0.5); // in the sphere's shadow
  vtkNew<vtkAxesActor> axes;
  axes->SetTotalLength(2.0, 2.0, 2.0);
  vtkNew<vtkTextActor> below;
  below->SetInput("below");
  vtkNew<vtkTextActor> above;
  above->SetInput("above");
  above->GetTextProperty()->SetColor(1.0, 0.0, 0.0);
  this->scene.renderer->AddActor(below);
  this->scene.renderer->AddActor(cube);
  this->scene.renderer->AddActor(axes);
  this->scene.addBox({ -2.0, -1.0, 0.0 }, { -1.5, -0.5, 1.0 });
  this->scene.renderer->AddActor(above);
  this->expectTheSame("annotations");

  vtkNew<vtkImageSlice> slice;
  vtkNew<vtkImageSliceMapper> image;
  image->SetInputData(
    makeImage(8, 8, [](int x, int y) { return glm::dvec3(0.1 * x, 0.1 * y, 1); }));
  slice->SetMapper(image);
  slice->GetProperty()->SetAmbient(1.0);
  slice->SetScale(0.2);
  slice->SetPosition(1.0, 0.5, 0.4);
  vtkNew<vtkImageStack> stack;
  stack->AddImage(slice);
  this->scene.renderer->AddViewProp(stack);
  this->expectTheSame("a stack of images");

  vtkNew<vtkAxisActor> axis;
  vtkNew<vtkAxisFollower> follower;
  follower->SetAxis(axis);
  follower->SetMapper(mapperOf(ballOf(glm::dvec3(0.0), 0.3)));
  follower->SetPosition(1.0, 0.2, 0.4);
  follower->SetCamera(this->scene.renderer->GetActiveCamera());
  this->scene.renderer->AddActor(follower);
  this->expectTheSame("an axis follower");

  vtkNew<vtkPropAssembly> together;
  together->AddPart(cube);
  together->AddPart(this->scene.sphere);
  this->scene.renderer->RemoveActor(cube);
  this->scene.renderer->RemoveActor(this->scene.sphere);
  this->scene.renderer->AddActor(together);
  EXPECT_EQ(this->autoRoute(), "image");
  EXPECT_THAT(this->scene.report().routeReason, HasSubstr("works on the whole screen"));
}

/// The translucent part of an opaque prop is blended over the surfaces behind it, in light and in
/// shadow.
TEST_F(Deferred, OpaquePropsThatBlendAreOverBoth)
{
  const auto texture =
    textureOf(makeVeil(4, 4, [](int x, int y) { return 60 + 12 * (x + 4 * y); }));
  vtkActor* veil = this->scene.addFloor(2.5, 0.6);
  veil->SetTexture(texture);
  veil->ForceOpaqueOn();
  veil->GetProperty()->SetAmbient(0.2);
  this->scene.floor()->VisibilityOff(); // the background is then behind the shadow
  this->scene.window->SetSize(200, 200);
  this->scene.renderer->SetBackground(0.7, 0.1, 0.3);
  this->scene.renderer->SetBackgroundAlpha(0.4);
  this->expectTheSame("over one colour");
  this->scene.renderer->GradientBackgroundOn();
  this->scene.renderer->SetBackground2(0.2, 0.4, 0.9);
  this->expectTheSame("over a gradient");
  vtkNew<vtkRenderer> below;
  below->GradientBackgroundOn();
  below->SetBackground2(0.2, 0.4, 0.9);
  this->scene.renderer->GradientBackgroundOff();
  this->scene.window->AddRenderer(below);
  this->scene.window->SetNumberOfLayers(2);
  this->scene.renderer->SetLayer(1);
  this->expectTheSame("over another renderer's picture");
}
