// The quality of moment maps of all techniques and projections with default settings: lit surfaces
// are lit, shadows begin at their casters, and no view breaks them.

#include "PassScene.h"
#include "Variant.h"

#include <vtkAppendPolyData.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

void addSphereOverFloor(PassScene& scene)
{
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  scene.addSun({ 1.0, 0.4, -1.5 });
  scene.lookFrom({ 0.0, -9.0, 7.0 });
}

class MomentMaps
  : public PassTest
  , public testing::WithParamInterface<Variant>
{
protected:
  static void choose(PassScene& scene) { GetParam().choose(scene); }
};

INSTANTIATE_TEST_SUITE_P(Layouts, MomentMaps,
  testing::ValuesIn(variantsThat(
    [](const Variant& variant)
    {
      return variant.isMoments() && variant.text.find("kernel_size") == std::string::npos &&
        variant.text.find("map_samples") == std::string::npos;
    })),
  testing::PrintToStringParamName());

} // namespace

TEST_P(MomentMaps, shadowsTouchTheirCasters)
{
  // A wall on a floor, thinner than a texel, seen from above; its shadow begins at x = 0.1.
  PassScene scene(400, 400);
  choose(scene);
  scene.addFloor(4.0);
  scene.addBox({ 0.099, -3.0, 0.0 }, { 0.1, 3.0, 1.0 });
  scene.addSun({ 1.0, 0.0, -1.0 });
  scene.pass->SetMapSize(1024);
  scene.lookDown(0.2, 0.2);
  const VisibilityImages& kept = drawKept(scene);
  const double texel = (8.0 + 1.0) / 1024 * std::sqrt(2.0); // on the floor, at most
  for (const std::size_t y : { 100, 200, 300 })
  {
    double begin = 1.0;
    for (std::size_t i = y * 400; i < (y + 1) * 400; ++i)
    {
      const double floorX = positionOf(kept, i).x;
      const bool dark = kept.normalZ[i] > 0.9f && kept.visibility[0][i] < 0.5f;
      begin = dark && floorX > 0.1001 ? std::min(begin, floorX) : begin;
    }
    EXPECT_LE(begin - 0.1, 3.0 * texel) << "row " << y;
  }
}

TEST_P(MomentMaps, severalSamplesOfATexelAreNearerToItsMean)
{
  // A plate whose edges cross the texels of a coarse map; one sample per texel shows stairs.
  PassScene scene(200, 200);
  choose(scene);
  scene.addFloor(4.0);
  vtkNew<vtkTransform> turn;
  turn->RotateZ(17.0);
  scene.addBox({ -1.5, -1.5, 2.0 }, { 1.5, 1.5, 2.1 })->SetUserTransform(turn);
  scene.addSun({ 0.0, 0.0, -1.0 });
  scene.pass->SetSetting("kernel_size", "1");
  scene.pass->SetSetting("bleeding", "0");
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  const auto draw = [&](int size, const char* kernelSize, const char* samples)
  {
    scene.pass->SetMapSize(size);
    scene.pass->SetSetting("kernel_size", kernelSize);
    scene.pass->SetSetting("map_samples", samples);
    std::vector<float> visibility = drawKept(scene).visibility[0];
    EXPECT_EQ(scene.report().mapBakes, 1);
    EXPECT_EQ(scene.report().lights[0].mapSamples, std::stoi(samples));
    return visibility;
  };
  // A texel's mean together with the bilinear filter is as wide as 1.75 texels of equal weight.
  const std::vector<float> smooth = draw(512, "14", "1");
  const double one = meanDifference(draw(64, "1", "1"), smooth);
  const std::size_t bytes = scene.report().bytesMaps;
  const double four = meanDifference(draw(64, "1", "4"), smooth);
  EXPECT_GT(scene.report().bytesMaps, bytes + 3 * 64 * 64 * 8);
  EXPECT_LE(four, 0.7 * one);
  EXPECT_EQ(meanDifference(draw(64, "1", "1"), smooth), one);
  EXPECT_EQ(scene.report().bytesMaps, bytes);
}

TEST_F(PassTest, samplesThatOpenGlDoesNotHaveAreNoted)
{
  PassScene scene(100, 80);
  addSphereOverFloor(scene);
  scene.pass->SetTechnique("vsm");
  scene.pass->SetSetting("map_samples", "8");
  scene.render();
  const int samples = scene.report().lights[0].mapSamples;
  const std::string note = "light 0: OpenGL supports at most " + std::to_string(samples) +
    " samples per texel of a map, not 8";
  EXPECT_EQ(scene.report().notes,
    samples == 8 ? std::vector<std::string>() : std::vector<std::string>{ note });
}

namespace
{

/// A long floor with near and far bars over it, along and across the map, and a sphere.
void fillWithBars(PassScene& scene)
{
  scene.addFloor(20.0);
  for (const double y : { -18.0, -14.0, -6.0, 6.0, 17.0 })
  {
    scene.addBox({ -3.0, y, 1.0 }, { 3.0, y + 0.8, 1.1 });
  }
  scene.addBox({ 4.0, -19.0, 1.0 }, { 4.8, 19.0, 1.1 });
  scene.addSphere({ -5.0, -12.0, 1.5 }, 1.0);
}

} // namespace

/// A kernel's width across the light is the same on warped, split and fitted maps as on a fine
/// uniform one.
TEST_F(PassTest, tablesBlurAllMapsAlike)
{
  PassScene scene(300, 300);
  fillWithBars(scene);
  scene.addSun({ 0.0, 0.3, -1.0 });
  scene.lookFrom({ 0.0, -24.0, 5.0 }, { 0.0, -10.0, 0.0 });
  scene.pass->SetTechnique("vsm");
  scene.pass->SetSetting("kernel_size", "9");
  const auto draw =
    [&](const char* projection, const char* fit, const char* blur, const char* width, int size)
  {
    scene.pass->SetSetting("projection", projection);
    scene.pass->SetSetting("fit", fit);
    scene.pass->SetSetting("blur", blur);
    scene.pass->SetSetting("kernel_width", width);
    scene.pass->SetMapSize(size);
    return drawKept(scene).visibility[0];
  };
  const std::vector<float> fine = draw("uniform", "off", "sat", "0.7", 2048);
  const double boxes = meanDifference(fine, draw("lispsm", "off", "box", "0", 512));
  for (const char* projection : { "uniform", "lispsm", "tsm", "pssm" })
  {
    const double difference = meanDifference(fine, draw(projection, "frame", "sat", "0.7", 512));
    EXPECT_LE(difference, 0.3 * boxes) << projection;
  }
}

TEST_F(PassTest, momentsThatNoTableHoldsAreNotSummed)
{
  PassScene scene(100, 80);
  scene.addFloor(4.0);
  scene.addSun({ 1.0, 0.4, -1.5 });
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  scene.pass->SetTechnique("evsm");
  scene.pass->SetSetting("blur", "sat");
  scene.render();
  EXPECT_THAT(this->takeErrors(),
    testing::HasSubstr("'exponential' has moments beyond the range of the 32-bit integers"));
}

namespace
{

/// Three rows of thin posts on a floor of half side 20, under a slanting sun.
void fillWithFences(PassScene& scene, const glm::dvec3& sun = { 0.25, 1.0, -0.8 })
{
  scene.addFloor(20.0);
  vtkNew<vtkAppendPolyData> fences;
  for (const double y : { -12.0, 0.0, 12.0 })
  {
    for (double x = -18.0; x <= 18.0; x += 0.4)
    {
      vtkNew<vtkCubeSource> post;
      post->SetBounds(x, x + 0.15, y, y + 0.1, 0.0, 2.0);
      fences->AddInputConnection(post->GetOutputPort());
    }
  }
  scene.add(fences);
  scene.addSun(sun);
}

/// Return the lit share of the floor in each pixel, by 8 x 8 shadow rays. Negative if the pixel
/// also shows other surfaces.
std::vector<float> litShareOfFloor(PassScene& scene)
{
  constexpr int rays = 8;
  const glm::ivec2 size(scene.window->GetSize()[0], scene.window->GetSize()[1]);
  scene.window->SetSize(rays * size.x, rays * size.y);
  scene.pass->SetTechnique("raytraced");
  const VisibilityImages& traced = drawKept(scene);
  std::vector<float> share;
  for (int y = 0; y < size.y; ++y)
  {
    for (int x = 0; x < size.x; ++x)
    {
      float sum = 0.0f;
      bool floor = true;
      for (int i = 0; i < rays * rays; ++i)
      {
        const int row = rays * y + i / rays;
        const auto pixel = static_cast<std::size_t>(row * rays * size.x + rays * x + i % rays);
        floor = floor && positionOf(traced, pixel).z < 1e-3;
        sum += traced.visibility[0][pixel];
      }
      share.push_back(floor ? sum / (rays * rays) : -1.0f);
    }
  }
  scene.window->SetSize(size.x, size.y);
  return share;
}

/// Return a picture's mean difference from that share.
double meanError(const VisibilityImages& kept, const std::vector<float>& truth)
{
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    if (truth[i] >= 0.0f)
    {
      sum += std::abs(kept.visibility[0][i] - truth[i]);
      ++count;
    }
  }
  EXPECT_GT(count, 1000.0);
  return sum / std::max(count, 1.0);
}

} // namespace

TEST_F(PassTest, levelsBringFarShadowsNearerToWhatPixelsShow)
{
  for (const bool parallel : { false, true })
  {
    PassScene scene(120, 80);
    fillWithFences(
      scene, { 0.25, -1.0, -0.8 }); // shadows fall before the fences, where the camera sees them
    scene.lookFrom({ 10.0, -140.0, 90.0 });
    vtkCamera* camera = scene.renderer->GetActiveCamera();
    camera->SetViewAngle(12.0);
    camera->SetParallelProjection(parallel);
    camera->SetParallelScale(16.0);
    const std::vector<float> truth = litShareOfFloor(scene);
    for (const char* technique : { "vsm", "evsm", "msm" })
    {
      for (const char* projection : { "uniform", "lispsm", "pssm" })
      {
        scene.pass->SetTechnique(technique);
        scene.pass->SetSetting("projection", projection);
        scene.pass->SetMapSize(1024);
        scene.pass->SetSetting("mip_maps", "off");
        const double without = meanError(drawKept(scene), truth);
        scene.pass->SetSetting("mip_maps", "on");
        const double with = meanError(drawKept(scene), truth);
        EXPECT_EQ(scene.report().mapBakes, 1);
        const std::string name =
          std::string(technique) + "_" + projection + (parallel ? "_parallel" : "");
        EXPECT_LE(with, 0.4 * without) << name;
      }
    }
    scene.pass->SetSetting("mip_maps", "off");
    scene.pass->SetSetting("projection", "technique");
  }
}
