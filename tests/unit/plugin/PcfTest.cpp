// Percentage closer filtering with every kernel: shadows reach as far from contacts as the kernel
// and no farther, and no setting breaks it.

#include "PassScene.h"

#include "lights/LightViews.h"
#include "shadowtech/depth_map/Pcf.h"

#include <vtkInformation.h>
#include <vtkInformationStringKey.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;
using testing::HasSubstr;

namespace
{

struct Kernel
{
  const char* name;
  int texels;
};

std::ostream& operator<<(std::ostream& stream, const Kernel& kernel)
{
  return stream << kernel.name << " " << kernel.texels;
}

class Pcf
  : public PassTest
  , public testing::WithParamInterface<Kernel>
{
protected:
  /// Give a light the test's kernel, and the pass the technique.
  static void choose(PassScene& scene, vtkLight* light)
  {
    scene.pass->SetTechnique("pcf");
    vtkGnomonLightKeys::SetSetting(light, "kernel", GetParam().name);
    vtkGnomonLightKeys::SetSetting(light, "kernel_size", std::to_string(GetParam().texels).c_str());
  }

  static gnomon::MapReach reach()
  {
    gnomon::ShadowLight light;
    gnomon::findSetting("kernel")->set(light, GetParam().name);
    light.kernel.sizeTexels = GetParam().texels;
    return gnomon::Pcf().mapReach(light);
  }
};

INSTANTIATE_TEST_SUITE_P(Kernels, Pcf,
  testing::Values(Kernel{ "bilinear", 1 }, Kernel{ "bilinear", 3 }, Kernel{ "bilinear", 8 },
    Kernel{ "box", 1 }, Kernel{ "box", 4 }, Kernel{ "box", 9 }, Kernel{ "poisson", 6 },
    Kernel{ "poisson", 32 }, Kernel{ "castano", 3 }, Kernel{ "castano", 7 }),
  [](const testing::TestParamInfo<Kernel>& kernel)
  { return kernel.param.name + std::to_string(kernel.param.texels); });

/// A sphere over a floor under a sun.
class KernelSettings : public PassTest
{
protected:
  KernelSettings()
  {
    this->scene.addFloor(4.0);
    this->scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
    this->scene.pass->SetTechnique("pcf");
    this->scene.lookFrom({ 0.0, -9.0, 7.0 });
  }

  PassScene scene{ 100, 80 };
  vtkLight* sun = this->scene.addSun({ 1.0, 0.4, -1.5 });
};

} // namespace

TEST_P(Pcf, shadowsBeginWithinTheKernelsReachOfTheirCasters)
{
  // A wall on a floor, thinner than a texel, so it casts with the face that is pushed back. Its
  // shadow begins at x = 0.1.
  constexpr int mapSize = 512;
  const glm::dvec3 lower(0.099, -3.0, 0.0);
  const glm::dvec3 upper(0.1, 3.0, 2.0);
  for (const glm::dvec3& direction :
    { glm::dvec3(1.0, 0.0, -1.0), { 0.4, 0.0, -1.0 }, { 3.0, 0.0, -1.0 } })
  {
    PassScene scene(500, 500);
    scene.addFloor(4.0);
    scene.addBox(lower, upper);
    choose(scene, scene.addSun(direction));
    scene.pass->SetMapSize(mapSize);
    scene.lookDown(0.4, 0.4);
    const VisibilityImages& kept = drawKept(scene);

    gnomon::ShadowLight sun;
    sun.directionWorld = glm::normalize(direction);
    gnomon::Bounds casters{ { -4.0, -4.0, 0.0 }, { 4.0, 4.0, 2.0 } };
    const gnomon::LightViews views = gnomon::fitLightViews(
      sun, { glm::dvec3(0.0), casters, {}, { mapSize, reach().borderTexels() }, {} });
    const auto texelOf = [&](double x)
    {
      const glm::dvec4 clip = views.views[0].clipFromCentred() * glm::dvec4(x, 0.0, 0.0, 1.0);
      return glm::dvec2(clip) * (0.5 * mapSize);
    };
    double farthest = 0.0;
    for (int y = 100; y <= 400; y += 7)
    {
      double begin = std::numeric_limits<double>::infinity();
      for (int x = 0; x < 500; ++x)
      {
        const std::size_t i = static_cast<std::size_t>(y) * 500 + static_cast<std::size_t>(x);
        const glm::dvec3 point = positionOf(kept, i);
        if (kept.normalZ[i] > 0.9f && point.x > 0.1001 && kept.visibility[0][i] < 0.5f)
        {
          begin = std::min(begin, point.x);
        }
      }
      ASSERT_LT(begin, 0.8) << "row " << y;
      farthest = std::max(farthest, glm::distance(texelOf(begin), texelOf(0.1)));
    }
    EXPECT_LE(farthest, 0.5 * GetParam().texels + 1.0) << "sun along " << direction.x;
  }
}

TEST_P(Pcf, edgesAreAsSmoothWhereTheMapEnds)
{
  // The box alone casts, so the map ends at the shadow's end, except for the border.
  constexpr int mapSize = 256;
  PassScene scene(400, 400);
  vtkGnomonPropKeys::SetCasts(scene.addFloor(4.0), false);
  scene.addBox({ -1.0, -1.0, 2.0 }, { 1.0, 1.0, 2.1 });
  choose(scene, scene.addSun({ 0.0, 0.0, -1.0 }));
  scene.pass->SetMapSize(mapSize);
  scene.lookDown(1.0, 1.0); // half of the picture is floor
  const VisibilityImages& kept = drawKept(scene);
  const double pixelTexels = 2.0 / 400 / (2.0 / mapSize);
  const auto lit = [&](int x) { return static_cast<double>(kept.visibility[0][200 * 400 + x]); };
  double largestStep = 0.0;
  for (int x = 1; x < 400; ++x)
  {
    const std::size_t i = 200 * 400 + static_cast<std::size_t>(x);
    if (kept.positionZ[i] + kept.origin[2] < 1.0 && kept.positionZ[i - 1] + kept.origin[2] < 1.0)
    {
      largestStep = std::max(largestStep, std::abs(lit(x) - lit(x - 1)));
    }
  }
  EXPECT_LT(pixelTexels, 1.0);
  EXPECT_EQ(lit(399), 1.0);
  // Visibility changes by a texel's column at a time: for Castano's kernel at most the middle one;
  // for a disc the points in it, which differ from place to place.
  const std::string name = GetParam().name;
  const double castano = GetParam().texels == 3 ? 2.0 / 4.0 : 16.0 / 52.0; // of 3 and of 7
  const double column = name == "poisson" ? 0.35
    : name == "castano"                   ? castano + 1e-6
                                          : 1.0 / GetParam().texels + 1e-6;
  EXPECT_LE(largestStep, column);
}

TEST_P(Pcf, steepCastersStayCastersForWhatLiesBehindAllOfThem)
{
  // A sheet that stands steeply in the light is the only caster. Pushed back far beyond the end of
  // the map's depths, it still hides the floor.
  for (const bool lamp : { false, true })
  {
    PassScene scene(300, 300);
    vtkNew<vtkTransform> stand;
    stand->Translate(0.0, 0.0, 3.0);
    stand->RotateY(85.0);
    scene.addFloor(1.0)->SetUserTransform(stand);
    vtkGnomonPropKeys::SetCasts(scene.addFloor(6.0), false);
    choose(scene,
      lamp ? scene.addSpot({ 0.0, 0.0, 12.0 }, glm::dvec3(0.0), 30.0)
           : scene.addSun({ 0.0, 0.0, -1.0 }));
    scene.pass->SetMapSize(64);
    // A point below the middle of its lower half.
    const double x = 0.5 * std::cos(glm::radians(85.0)) * (lamp ? 12.0 / 9.5 : 1.0);
    scene.lookFrom({ 4.0, -6.0, 5.0 }, { x, 0.0, 0.0 });
    scene.renderer->GetActiveCamera()->SetViewAngle(1.0);
    const VisibilityImages& kept = drawKept(scene);
    double darkest = 1.0;
    std::size_t points = 0;
    for (std::size_t i = 0; i < kept.coverage.size(); ++i)
    {
      const glm::dvec3 point = positionOf(kept, i);
      if (kept.coverage[i] > 0.0f && std::abs(point.z) < 0.001 &&
        glm::distance(point, glm::dvec3(x, 0.0, 0.0)) < 0.005)
      {
        ++points;
        darkest = std::min(darkest, static_cast<double>(kept.visibility[0][i]));
      }
    }
    EXPECT_GT(points, 10u);
    EXPECT_LT(darkest, 0.5) << "lamp: " << lamp;
  }
}

TEST_F(KernelSettings, kernelsOfTechniquesThatHaveTheirOwnAreReported)
{
  this->scene.pass->SetSetting(
    "kernel", "castano"); // these techniques ignore it, also that it has no size 6
  this->scene.pass->SetSetting("kernel_size", "6");
  for (const auto& [technique, kernel] : std::map<std::string, std::string>{
         { "adaptive", "disc" }, { "vsm", "square" }, { "evsm", "square" }, { "msm", "square" } })
  {
    this->scene.pass->SetTechnique(technique.c_str());
    this->scene.render();
    EXPECT_EQ(this->scene.report().lights[0].kernel, kernel) << technique;
    EXPECT_EQ(this->scene.report().lights[0].kernelTexels, 6) << technique;
  }
}

TEST_F(KernelSettings, unknownKernelIsAnErrorThatNamesTheOthers)
{
  vtkGnomonLightKeys::SetSetting(this->sun, "kernel", "magic");
  EXPECT_THAT(
    this->takeErrors(), HasSubstr("'kernel', expected one of: bilinear, box, poisson, castano"));
  this->scene.render();
  EXPECT_EQ(this->takeErrors(), "");
  // Bypass the function that refuses it.
  for (const char* part : { "kernel", "magic" })
  {
    this->sun->GetInformation()->Append(vtkGnomonLightKeys::SETTINGS(), part);
  }
  this->scene.render();
  EXPECT_EQ(this->scene.report().route, "none");
  EXPECT_EQ(this->scene.report().lights[0].reason,
    "its setting 'kernel' is 'magic', expected one of: bilinear, box, poisson, castano");
}
