// The hook into VTK's shaders must not exceed OpenGL's limits.

#include "PassScene.h"
#include "Variant.h"

#include <vtkShaderProperty.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

using ShaderManager = PassTestOf<Variant>;

/// One variant for each set of samplers.
bool hasSamplersOfItsOwn(const Variant& variant)
{
  return variant.isPointwise() &&
    (variant.text == variant.technique() || variant.text == "vsm blur=sat");
}

} // namespace

/// The shaders that draw the first frame's receivers have samplers of maps that do not exist yet.
TEST_BY_VARIANTS(ShaderManager, FirstFrameWithTranslucentReceivers, hasSamplersOfItsOwn)
{
  SphereUnderSun scene(64, 48);
  const auto texture = textureOf(makeImage(2, 2, [](int, int) { return glm::dvec3(0.8); }));
  scene.floor()->SetTexture(texture);
  vtkActor* const pane = scene.addFloor(1.0);
  pane->SetPosition(0.5, 0.0, 2.5);
  pane->GetProperty()->SetOpacity(0.5);
  GetParam().choose(scene);
  GetParam().set(scene.pass, "light_radius", "2");
  scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_IMAGE);
  scene.pass->KeepVisibilityOn();

  const Picture first = scene.render();
  const VisibilityImages& kept = scene.pass->GetVisibility();
  EXPECT_GT(std::count(kept.coverage.begin(), kept.coverage.end(), 1.0f), 1000);
  scene.window->SetSize(65, 48);
  scene.render();
  scene.window->SetSize(64, 48);
  EXPECT_EQ(differingPixels(scene.render(), first), 0u);
}

/// A user's own code after VTK's lighting can use its results.
TEST(ShaderManagerWithCode, ReadsVtksLightingByBothRoutes)
{
  SphereUnderSun scene(64, 48);
  const Picture before = scene.render(tracedWay);
  scene.sphere->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
    "//VTK::Light::Impl\n"
    "  gl_FragData[0] = vec4(ambientColor + vec3(diffuse.r, 0.0, 0.0) + specular, 1.0);\n",
    false);
  const Picture traced = scene.render(tracedWay);
  std::size_t red = 0;
  for (std::size_t i = 0; i < traced.pixels(); ++i)
  {
    red += traced.rgb[3 * i] > 100 && traced.rgb[3 * i + 1] == 0 ? 1 : 0;
    EXPECT_EQ(traced.rgb[3 * i], before.rgb[3 * i]); // shadows are the same
  }
  EXPECT_GT(red, 30u);
  const Picture inlined = scene.render({ "nsm", vtkGnomonShadowPass::ROUTE_INLINE });
  const Picture image = scene.render({ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE });
  EXPECT_LE(differingPixels(inlined, image, 2), 1u);
}

/// A user's whole shader has no marks for lighting. What it draws hides receivers, and has no rays.
TEST(ShaderManagerWithCode, LeavesNoReceiverWhereAWholeShaderDraws)
{
  PassScene scene(64, 48);
  scene.addFloor(9.0);
  vtkActor* const plate = scene.addFloor(1.5, 1.0);
  plate->GetShaderProperty()->SetFragmentShaderCode("//VTK::System::Dec\n"
                                                    "//VTK::Output::Dec\n"
                                                    "void main(void)\n"
                                                    "{\n"
                                                    "  gl_FragData[0] = vec4(1.0, 0.0, 1.0, 1.0);\n"
                                                    "  if (gl_FragCoord.x < 32.0) { return; }\n"
                                                    "  gl_FragData[0].g = 1.0;\n"
                                                    "}\n");
  scene.addSun({ 1.0, 0.4, -1.5 });
  scene.lookDown(3.0);
  scene.choose({ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE });
  const Picture picture = scene.render();
  const auto isPlate = [&](int x, int y)
  { return picture.at(x, y) == glm::ivec3(255, x < 32 ? 0 : 255, 255); }; // the left returns early
  const auto platePixels = static_cast<std::int64_t>(countPixels(picture, isPlate));
  EXPECT_GT(platePixels, 500);
  EXPECT_EQ(scene.report().lights.at(0).tracedPixels + platePixels,
    static_cast<std::int64_t>(picture.pixels()));
}
