// Quality of shadow maps with default settings: shadows begin at their casters, filters reach as
// far as their kernels, and no setting breaks a map.

#include "PassScene.h"
#include "Variant.h"

#include "lights/LightViews.h"
#include "shadowtech/depth_map/Pcf.h"

#include <vtkAppendPolyData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;
using testing::HasSubstr;

namespace
{

bool names(const Variant& variant, const char* setting)
{
  return variant.text.find(setting) != std::string::npos;
}

using HardMaps = PassTestOf<Variant>;
INSTANTIATE_TEST_SUITE_P(Layouts, HardMaps,
  testing::ValuesIn(
    variantsThat([](const Variant& variant) { return variant.info().name == "compare"; })),
  testing::PrintToStringParamName());

using BakedMaps = PassTestOf<Variant>;
INSTANTIATE_TEST_SUITE_P(All, BakedMaps,
  testing::ValuesIn(variantsThat(
    [](const Variant& variant)
    {
      return variant.info().bakesMap() && !names(variant, "kernel_") &&
        !names(variant, "light_radius");
    })),
  testing::PrintToStringParamName());

using MomentMaps = PassTestOf<Variant>;
INSTANTIATE_TEST_SUITE_P(Layouts, MomentMaps,
  testing::ValuesIn(variantsThat(
    [](const Variant& variant)
    {
      return variant.isMoments() && !names(variant, "kernel_size") &&
        !names(variant, "map_samples");
    })),
  testing::PrintToStringParamName());

struct Kernel
{
  const char* name;
  int texels;
};
std::ostream& operator<<(std::ostream& stream, const Kernel& kernel)
{
  return stream << kernel.name << kernel.texels;
}

struct Pcf : PassTestOf<Kernel>
{
  /// Give a light the test's kernel, and the pass the technique.
  static void choose(PassScene& scene, vtkLight* light)
  {
    scene.pass->SetTechnique("pcf");
    set(light, "kernel", GetParam().name);
    set(light, "kernel_size", std::to_string(GetParam().texels).c_str());
  }
};
INSTANTIATE_TEST_SUITE_P(Kernels, Pcf,
  testing::Values(Kernel{ "bilinear", 1 }, Kernel{ "bilinear", 3 }, Kernel{ "bilinear", 8 },
    Kernel{ "box", 1 }, Kernel{ "box", 4 }, Kernel{ "box", 9 }, Kernel{ "poisson", 6 },
    Kernel{ "poisson", 32 }, Kernel{ "castano", 3 }, Kernel{ "castano", 7 }),
  testing::PrintToStringParamName());

/// A wall on a floor under a sun along x, seen from above. Its shadow begins at x = 0.1.
struct WallScene : PassScene
{
  static constexpr int side = 500; // pixels

  WallScene(double thickness, const glm::dvec3& direction = slantingSun)
    : PassScene(side, side)
  {
    this->addFloor(4.0);
    this->addBox({ 0.1 - thickness, -3.0, 0.0 }, { 0.1, 3.0, 2.0 });
    this->sun = this->addSun(direction);
    this->lookDown(0.4, 0.4);
  }
  /// Return where the shadow begins in the row where it begins last.
  double begin()
  {
    const VisibilityImages& kept = drawKept(*this);
    double farthest = 0.0;
    for (int y = 100; y <= 400; y += 7)
    {
      double begin = std::numeric_limits<double>::infinity();
      for (int x = 0; x < side; ++x)
      {
        const std::size_t i = static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
        const double at = positionOf(kept, i).x;
        const bool dark = kept.normalZ[i] > 0.9f && kept.visibility[0][i] < 0.5f;
        begin = dark && at > 0.1001 ? std::min(begin, at) : begin;
      }
      farthest = std::max(farthest, begin);
    }
    return farthest;
  }
  /// Return the length of a texel's footprint on the floor, at most.
  static double texel(int mapSize) { return (8.0 + 1.0) / mapSize * std::sqrt(2.0); }

  vtkLight* sun;
};
constexpr double thinnerThanATexel = 0.001; // the wall casts with the face that is pushed back

} // namespace

TEST_P(HardMaps, shadowsTouchTheirCasters)
{
  WallScene scene(thinnerThanATexel);
  GetParam().choose(scene);
  for (const int mapSize : { 256, 1024 })
  {
    scene.pass->SetMapSize(mapSize);
    EXPECT_LE(scene.begin() - 0.1, WallScene::texel(mapSize) + 0.002) << "map " << mapSize;
  }
}

TEST_P(MomentMaps, shadowsTouchTheirCasters)
{
  WallScene scene(thinnerThanATexel);
  GetParam().choose(scene);
  scene.pass->SetMapSize(1024);
  EXPECT_LE(scene.begin() - 0.1, 3.0 * WallScene::texel(1024));
}

TEST_P(Pcf, shadowsBeginWithinTheKernelsReachOfTheirCasters)
{
  constexpr int mapSize = 512;
  gnomon::ShadowLight kernel;
  gnomon::findSetting("kernel")->set(kernel, GetParam().name);
  kernel.kernel.sizeTexels = GetParam().texels;
  for (const glm::dvec3& direction :
    { glm::dvec3(1.0, 0.0, -1.0), { 0.4, 0.0, -1.0 }, { 3.0, 0.0, -1.0 } })
  {
    WallScene scene(thinnerThanATexel, direction);
    choose(scene, scene.sun);
    scene.pass->SetMapSize(mapSize);
    gnomon::ShadowLight sun;
    sun.directionWorld = glm::normalize(direction);
    const gnomon::LightViews views = gnomon::fitLightViews(sun,
      { glm::dvec3(0.0), { { -4.0, -4.0, 0.0 }, { 4.0, 4.0, 2.0 } }, {},
        { mapSize, gnomon::Pcf().mapReach(kernel).borderTexels() }, {} });
    const auto texelOf = [&](double x)
    {
      const glm::dvec4 clip = views.views[0].clipFromCentred() * glm::dvec4(x, 0.0, 0.0, 1.0);
      return glm::dvec2(clip) * (0.5 * mapSize);
    };
    const double begin = scene.begin();
    ASSERT_LT(begin, 0.8);
    EXPECT_LE(glm::distance(texelOf(begin), texelOf(0.1)), 0.5 * GetParam().texels + 1.0)
      << "sun along " << direction.x;
  }
}

/// The only caster is a sheet that stands steeply in the light. Pushed back far beyond the end of
/// the map's depths, it still hides the floor below the middle of its lower half.
TEST_P(Pcf, steepCastersStayCastersForWhatLiesBehindAllOfThem)
{
  for (const bool lamp : { false, true })
  {
    PassScene scene(20, 20);
    vtkNew<vtkTransform> stand;
    stand->Translate(0.0, 0.0, 3.0);
    stand->RotateY(85.0);
    scene.addFloor(1.0)->SetUserTransform(stand);
    vtkGnomonPropKeys::SetCasts(scene.addFloor(6.0), false);
    choose(scene,
      lamp ? scene.addSpot({ 0.0, 0.0, 12.0 }, glm::dvec3(0.0), 30.0)
           : scene.addSun({ 0.0, 0.0, -1.0 }));
    scene.pass->SetMapSize(64);
    const double x = 0.5 * std::cos(glm::radians(85.0)) * (lamp ? 12.0 / 9.5 : 1.0);
    scene.lookFrom({ 4.0, -6.0, 5.0 }, { x, 0.0, 0.0 });
    scene.renderer->GetActiveCamera()->SetViewAngle(0.05);
    const VisibilityImages& kept = drawKept(scene);
    EXPECT_LT(std::abs(positionOf(kept, 0).z), 0.001) << "the floor is seen";
    EXPECT_LT(*std::min_element(kept.visibility[0].begin(), kept.visibility[0].end()), 0.5f)
      << lamp;
  }
}

TEST_P(BakedMaps, receiversThatDoNotCastMayLieBehindAllCasters)
{
  for (const bool spot : { false, true })
  {
    PassScene scene(300, 300);
    vtkGnomonPropKeys::SetCasts(scene.addFloor(4.0), false);
    scene.addSphere({ -1.0, 0.0, 2.5 }, 0.7);
    spot ? scene.addSpot({ -2.0, 0.0, 5.0 }, glm::dvec3(0.0), 50.0)
         : scene.addSun({ 1.0, 0.4, -1.5 });
    scene.lookFrom({ 0.0, -9.0, 7.0 });
    const VisibilityImages traced = drawKept(scene, "raytraced");
    const Agreement agreement = compareVisibility(drawKept(scene, GetParam().text.c_str()), traced);
    EXPECT_GT(agreement.covered, 20000u);
    // The map's square has empty corners; moments blur its edges.
    EXPECT_LE(agreement.wrong, GetParam().isMoments() ? 150u : 40u) << "spot: " << spot;
  }
}

TEST_P(MomentMaps, severalSamplesOfATexelAreNearerToItsMean)
{
  // A plate whose edges cross the texels of a coarse map; one sample per texel shows stairs.
  PassScene scene(200, 200);
  GetParam().choose(scene);
  scene.addFloor(4.0);
  scene.addBox({ -1.5, -1.5, 2.0 }, { 1.5, 1.5, 2.1 })->RotateZ(17.0);
  scene.addSun({ 0.0, 0.0, -1.0 });
  scene.choose("bleeding=0");
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  const auto draw = [&](const char* settings, int samples)
  {
    std::vector<float> visibility = scene.visibilityBy(settings);
    EXPECT_EQ(scene.report().mapBakes, 1);
    EXPECT_EQ(scene.report().lights[0].mapSamples, samples);
    return visibility;
  };
  // A texel's mean together with the bilinear filter is as wide as 1.75 texels of equal weight.
  const std::vector<float> smooth = draw("map_size=512 kernel_size=14 map_samples=1", 1);
  const double one = meanDifference(draw("map_size=64 kernel_size=1 map_samples=1", 1), smooth);
  const std::size_t bytes = scene.report().bytesMaps;
  const double four = meanDifference(draw("map_samples=4", 4), smooth);
  EXPECT_GT(scene.report().bytesMaps, bytes + 3 * 64 * 64 * 8);
  EXPECT_LE(four, 0.7 * one);
  EXPECT_EQ(meanDifference(draw("map_samples=1", 1), smooth), one);
  EXPECT_EQ(scene.report().bytesMaps, bytes);
}

namespace
{

struct MapSettings : PassTest
{
  SphereUnderSun scene{ 100, 80 };
};

} // namespace

TEST_F(MapSettings, kernelsOfTechniquesThatHaveTheirOwnAreReported)
{
  this->scene.choose("kernel=castano kernel_size=6"); // ignored, also that there is no size 6
  for (const auto& [technique, kernel] : std::map<std::string, std::string>{
         { "adaptive", "disc" }, { "vsm", "square" }, { "evsm", "square" }, { "msm", "square" } })
  {
    this->scene.render(technique.c_str());
    EXPECT_EQ(this->scene.report().lights[0].kernel, kernel) << technique;
    EXPECT_EQ(this->scene.report().lights[0].kernelTexels, 6) << technique;
  }
}

TEST_F(MapSettings, unknownKernelIsAnErrorThatNamesTheOthers)
{
  this->scene.choose("pcf");
  set(this->scene.sun, "kernel", "magic");
  EXPECT_THAT(
    this->takeErrors(), HasSubstr("'kernel', expected one of: bilinear, box, poisson, castano"));
  this->scene.render();
  EXPECT_EQ(this->takeErrors(), "");
  // Bypass the function that refuses it.
  for (const char* part : { "kernel", "magic" })
  {
    this->scene.sun->GetInformation()->Append(vtkGnomonLightKeys::SETTINGS(), part);
  }
  this->scene.render();
  EXPECT_EQ(this->scene.report().route, "none");
  EXPECT_EQ(this->scene.report().lights[0].reason,
    "its setting 'kernel' is 'magic', expected one of: bilinear, box, poisson, castano");
}

TEST_F(MapSettings, samplesThatOpenGlDoesNotHaveAreNoted)
{
  this->scene.render("vsm map_samples=8");
  const int samples = this->scene.report().lights[0].mapSamples;
  const std::string note = "light 0: OpenGL supports at most " + std::to_string(samples) +
    " samples per texel of a map, not 8";
  EXPECT_EQ(this->scene.report().notes,
    samples == 8 ? std::vector<std::string>() : std::vector<std::string>{ note });
}

TEST_F(MapSettings, momentsThatNoTableHoldsAreNotSummed)
{
  this->scene.render("evsm blur=sat");
  EXPECT_THAT(this->takeErrors(),
    HasSubstr("'exponential' has moments beyond the range of the 32-bit integers"));
}

/// A kernel's width across the light is the same on warped, split and fitted maps as on a fine
/// uniform one.
TEST_F(PassTest, tablesBlurAllMapsAlike)
{
  PassScene scene(300, 300);
  scene.addFloor(20.0); // with near and far bars over it, along and across the map, and a sphere
  for (const double y : { -18.0, -14.0, -6.0, 6.0, 17.0 })
  {
    scene.addBox({ -3.0, y, 1.0 }, { 3.0, y + 0.8, 1.1 });
  }
  scene.addBox({ 4.0, -19.0, 1.0 }, { 4.8, 19.0, 1.1 });
  scene.addSphere({ -5.0, -12.0, 1.5 }, 1.0);
  scene.addSun({ 0.0, 0.3, -1.0 });
  scene.lookFrom({ 0.0, -24.0, 5.0 }, { 0.0, -10.0, 0.0 });
  scene.choose("vsm kernel_size=9");
  const std::vector<float> fine =
    scene.visibilityBy("projection=uniform fit=off blur=sat kernel_width=0.7 map_size=2048");
  const double boxes = meanDifference(
    fine, scene.visibilityBy("projection=lispsm fit=off blur=box kernel_width=0 map_size=512"));
  scene.choose("fit=frame blur=sat kernel_width=0.7");
  for (const char* projection :
    { "projection=uniform", "projection=lispsm", "projection=tsm", "projection=pssm" })
  {
    EXPECT_LE(meanDifference(fine, scene.visibilityBy(projection)), 0.3 * boxes) << projection;
  }
}

namespace
{

/// Three rows of thin posts on a floor of half side 20. Their shadows fall before them, where the
/// camera sees them.
void fillWithFences(PassScene& scene)
{
  scene.addFloor(20.0);
  vtkNew<vtkAppendPolyData> fences;
  for (const double y : { -12.0, 0.0, 12.0 })
  {
    for (double x = -18.0; x <= 18.0; x += 0.4)
    {
      fences->AddInputConnection(boxOf({ x, y, 0.0 }, { x + 0.15, y + 0.1, 2.0 })->GetOutputPort());
    }
  }
  scene.add(fences);
  scene.addSun({ 0.25, -1.0, -0.8 });
}

/// Return the lit share of the floor in each pixel, by 8 x 8 shadow rays. Negative if the pixel
/// also shows other surfaces.
std::vector<float> litShareOfFloor(PassScene& scene)
{
  constexpr int rays = 8;
  const glm::ivec2 size(scene.window->GetSize()[0], scene.window->GetSize()[1]);
  scene.window->SetSize(rays * size.x, rays * size.y);
  const VisibilityImages& traced = drawKept(scene, "raytraced");
  const auto width = static_cast<std::size_t>(size.x);
  std::vector<float> share(width * static_cast<std::size_t>(size.y));
  for (std::size_t i = 0; i < traced.coverage.size(); ++i)
  {
    const bool isFloor = positionOf(traced, i).z < 1e-3;
    share[i / (rays * rays * width) * width + i / rays % width] +=
      isFloor ? traced.visibility[0][i] / (rays * rays) : -1.0f;
  }
  scene.window->SetSize(size.x, size.y);
  return share;
}

/// Return a picture's mean difference from that share.
double meanError(const VisibilityImages& kept, const std::vector<float>& truth)
{
  return meanDifferenceWhere(
    kept.visibility[0], truth, 1000, [&](std::size_t i) { return truth[i] >= 0.0f; });
}

} // namespace

TEST_F(PassTest, levelsBringFarShadowsNearerToWhatPixelsShow)
{
  for (const bool parallel : { false, true })
  {
    PassScene scene(120, 80);
    fillWithFences(scene);
    scene.lookFrom({ 10.0, -140.0, 90.0 });
    vtkCamera* camera = scene.renderer->GetActiveCamera();
    camera->SetViewAngle(12.0);
    camera->SetParallelProjection(parallel);
    camera->SetParallelScale(16.0);
    const std::vector<float> truth = litShareOfFloor(scene);
    for (const char* technique : { "vsm", "evsm", "msm" })
    {
      for (const char* projection :
        { "projection=uniform", "projection=lispsm", "projection=pssm" })
      {
        SCOPED_TRACE(testing::Message() << technique << " " << projection << " " << parallel);
        scene.choose(technique);
        scene.choose(projection);
        const double without = meanError(drawKept(scene, "map_size=1024 mip_maps=off"), truth);
        const double with = meanError(drawKept(scene, "mip_maps=on"), truth);
        EXPECT_EQ(scene.report().mapBakes, 1);
        EXPECT_LE(with, 0.4 * without);
      }
    }
  }
}

namespace
{

/// A slab over a long floor, whose shadow's edge runs away from the camera.
struct SlabScene : PassScene
{
  SlabScene(int height, const glm::dvec3& sun, const glm::dvec3& target)
    : PassScene(200, height)
  {
    this->addFloor(100.0);
    this->addBox({ -40.0, -100.0, 3.0 }, { 0.0, 100.0, 4.0 });
    this->addSun(sun);
    this->lookFrom({ 3.0, -98.0, 2.0 }, target);
    this->choose("pssm map_size=128");
  }
};

} // namespace

/// Along a shadow's edge that runs away from the camera, one split's texels end and the next
/// split's begin. Values in between must lie between both.
TEST_F(PassTest, blendedSplitsFadeIntoEachOther)
{
  SlabScene scene(200, { 0.2, 0.13, -1.0 }, glm::dvec3(0.0));
  EXPECT_EQ(countBetween(drawKept(scene, "split_blend=0").visibility[0]), 0u);
  const VisibilityImages blended = drawKept(scene, "split_blend=0.3");
  EXPECT_GT(countBetween(blended.visibility[0]), 20u);
  EXPECT_EQ(scene.report().lights.at(0).fit, "frustum");

  // Compare both routes, and compare with the truth.
  EXPECT_GT(compareVisibility(blended, drawKept(scene, "raytraced")).agreeing(), 0.97);
  scene.pass->KeepVisibilityOff();
  const Picture image = scene.render({ "pssm", vtkGnomonShadowPass::ROUTE_IMAGE });
  const Picture inlined = scene.render({ "pssm", vtkGnomonShadowPass::ROUTE_INLINE });
  EXPECT_EQ(differingPixels(inlined, image, 1), 0u);
}

/// A filter's edges are as wide as a split's texels require. With blended splits, brightness
/// changes less from row to row of pixels than where one split ends.
TEST_F(PassTest, blendedSplitsHaveNoBorder)
{
  SlabScene scene(400, { 0.2, 0.0, -1.0 }, { 3.0, 100.0, -40.0 });
  scene.choose("estimator=pcf kernel_size=9");
  const auto largestStep = [&](const char* blend)
  {
    const VisibilityImages& kept = drawKept(scene, blend);
    const auto isFloor = [&](std::size_t i)
    { return kept.coverage[i] > 0.5f && positionOf(kept, i).z < 0.1 && kept.normalZ[i] > 0.9f; };
    float largest = 0.0f;
    for (std::size_t i = 0; i + 200 < kept.coverage.size(); ++i)
    {
      const float step = std::abs(kept.visibility[0][i] - kept.visibility[0][i + 200]);
      largest = isFloor(i) && isFloor(i + 200) ? std::max(largest, step) : largest;
    }
    return largest;
  };
  const float without = largestStep("split_blend=0");
  EXPECT_LT(largestStep("split_blend=0.3"), 0.7f * without);
}

TEST_F(PassTest, aSheetCastsNoShadowIntoASecondDepthMap)
{
  PassScene scene(300, 300);
  scene.addFloor(4.0);
  scene.addFloor(1.0, 2.0);
  scene.addSun(slantingSun);
  scene.lookDown(4.0);
  const auto shadowOf = [&](const char* text) { return scene.redAt(scene.render(text), 2.0, 0.0); };
  EXPECT_EQ(shadowOf("nsm depth=first"), 0);
  EXPECT_EQ(shadowOf("nsm depth=midpoint"), 0);
  EXPECT_NEAR(shadowOf("nsm depth=second"), slantingSunValue, 1.0);
}
