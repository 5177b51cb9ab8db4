// Shadows on translucent surfaces, against those on the same surfaces made opaque.

#include "PassScene.h"

#include <vtkDepthPeelingPass.h>
#include <vtkDualDepthPeelingPass.h>
#include <vtkOrderIndependentTranslucentPass.h>
#include <vtkRenderStepsPass.h>
#include <vtkShaderProperty.h>
#include <vtkTranslucentPass.h>

namespace gnomon::test
{
namespace
{

/// A way to blend translucent surfaces.
struct Blending
{
  const char* name;
  vtkSmartPointer<vtkRenderPass> (*pass)();
};

template <typename Outer>
vtkSmartPointer<vtkRenderPass> translucentBy()
{
  vtkNew<vtkTranslucentPass> inner;
  auto outer = vtkSmartPointer<Outer>::New();
  outer->SetTranslucentPass(inner);
  return outer;
}

const auto blendings = testing::Values(
  Blending{ "plain",
    [] { return vtkSmartPointer<vtkRenderPass>(vtkSmartPointer<vtkTranslucentPass>::New()); } },
  Blending{ "peeling", translucentBy<vtkDepthPeelingPass> },
  Blending{ "dual", translucentBy<vtkDualDepthPeelingPass> },
  Blending{ "weighted", translucentBy<vtkOrderIndependentTranslucentPass> });

/// A plate and a ball below slats, in a scene so wide that the map of all of it is coarse.
struct TranslucentReceivers : PassTestOf<std::tuple<Blending, const char*, Way>>
{
  static constexpr double opacity = 0.8;

  TranslucentReceivers()
  {
    this->scene.addBox({ -21.0, -21.0, 0.0 }, { -20.0, -20.0, 3.0 });
    this->scene.addBox({ 20.0, 20.0, 0.0 }, { 21.0, 21.0, 3.0 });
    for (int slat = 0; slat < 6; ++slat)
    {
      const double x = -4.0 + 1.1 * slat;
      this->slats.push_back(this->scene.addBox({ x, -2.0, 3.0 }, { x + 0.4, 0.9, 3.1 }));
    }
    this->ball = this->scene.addSphere({ 1.7, 0.0, 1.0 }, 1.0);
    this->plate = this->scene.addFloor(1.4, 1.0);
    this->plate->SetPosition(-1.0, 0.0, 0.0);
    this->plate->SetOrientation(0.0, 20.0, 10.0);
    for (vtkActor* receiver : { this->ball, this->plate })
    {
      receiver->GetProperty()->BackfaceCullingOn(); // one layer a pixel
      vtkGnomonPropKeys::SetCasts(receiver, false);
    }
    const bool isSun = std::string("sun") == std::get<1>(GetParam());
    isSun ? this->scene.addSun({ 0.4, 0.3, -1.0 })
          : this->scene.addSpot({ -1.5, -2.0, 8.0 }, { 0.3, 0.0, 1.0 }, 50.0);
    this->scene.lookFrom({ 0.3, -5.0, 7.0 }, { 0.3, 0.0, 1.0 });
    this->scene.choose(std::get<Way>(GetParam()));
    this->steps->SetTranslucentPass(std::get<Blending>(GetParam()).pass());
  }
  /// Draw with translucent or opaque receivers. Red values are those of opaque ones.
  std::vector<double> draw(bool translucent, bool shadows)
  {
    for (vtkActor* receiver : { this->ball, this->plate })
    {
      receiver->GetProperty()->SetOpacity(translucent ? opacity : 1.0);
    }
    this->scene.pass->SetDelegatePass(translucent ? this->steps.Get() : nullptr);
    for (vtkActor* slat : this->slats)
    {
      vtkGnomonPropKeys::SetCasts(slat, shadows);
    }
    const Picture picture = this->scene.render();
    std::vector<double> values;
    for (std::size_t i = 0; i < picture.pixels(); ++i)
    {
      values.push_back(picture.rgb[3 * i] / 255.0 / (translucent ? opacity : 1.0));
    }
    return values;
  }

  PassScene scene{ 200, 160 };
  std::vector<vtkActor*> slats;
  vtkActor* ball;
  vtkActor* plate;
  vtkNew<vtkRenderStepsPass> steps;
};

TEST_P(TranslucentReceivers, showShadowsLikeOpaqueOnes)
{
  // Where both are lit alike, the pixel shows a receiver alone.
  const std::vector<double> lit = this->draw(false, false);
  const std::vector<double> litThrough = this->draw(true, false);
  const std::vector<double> truth = this->draw(false, true);
  const std::vector<double> through = this->draw(true, true);
  std::size_t counted = 0;
  std::size_t dark = 0;
  std::size_t wrong = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < lit.size(); ++i)
  {
    if (lit[i] > 0.2 && std::abs(lit[i] - litThrough[i]) < 0.01)
    {
      const double difference = (through[i] - truth[i]) / lit[i];
      ++counted;
      dark += truth[i] < 0.5 * lit[i] ? 1 : 0;
      wrong += std::abs(difference) > 0.5 ? 1 : 0;
      squares += difference * difference;
    }
  }
  const double rms = std::sqrt(squares / static_cast<double>(counted));
  EXPECT_GT(counted, 4000u);
  EXPECT_GT(dark, counted / 8);
  EXPECT_LT(static_cast<double>(wrong), 0.005 * static_cast<double>(counted));
  EXPECT_LT(rms, 0.1);
  if (std::get<Blending>(GetParam()).name == std::string("plain")) // else VTK builds shaders
  {
    this->scene.render();
    EXPECT_EQ(this->scene.report().programCompiles + this->scene.report().mapBakes, 0) << "at rest";
  }
}

INSTANTIATE_TEST_SUITE_P(, TranslucentReceivers,
  testing::Combine(blendings, testing::Values("sun", "spot"),
    testing::Values(Way{ "silhouette", vtkGnomonShadowPass::ROUTE_AUTO },
      Way{ "nsm", vtkGnomonShadowPass::ROUTE_INLINE },
      Way{ "pcf", vtkGnomonShadowPass::ROUTE_IMAGE })),
  [](const auto& made)
  {
    return std::string(std::get<0>(made.param).name) + "_" + std::get<1>(made.param) + "_" +
      std::get<2>(made.param).technique;
  });

/// A user's code may move vertices out of the box that the map would be fitted to.
TEST_F(PassTest, movedTranslucentSurfacesShowShadows)
{
  PassScene scene(48, 48);
  scene.addBox({ -3.0, -1.0, 3.0 }, { -1.6, 1.0, 3.001 });
  scene.addSun({ 1.0, 0.0, -1.0 });
  scene.lookDown(1.5);
  scene.choose("raytraced");
  vtkActor* const moved = scene.addFloor(1.0, 1.0);
  moved->SetPosition(0.9, 0.0, 0.0);
  moved->GetProperty()->SetOpacity(0.8);
  moved->GetShaderProperty()->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true,
    "vec4 movedMC = vertexMC - vec4(0.9, 0.0, 0.0, 0.0);\n#define vertexMC movedMC\n"
    "//VTK::PositionVC::Impl",
    false);
  const Picture picture = scene.render();
  EXPECT_LT(scene.redAt(picture, -0.2, 0.0), 20);
  EXPECT_GT(scene.redAt(picture, 0.6, 0.0), 90);
}

} // namespace
} // namespace gnomon::test
