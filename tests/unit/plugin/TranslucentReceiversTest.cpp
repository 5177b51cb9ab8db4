// Shadows of opaque casters on translucent surfaces, against rays on the same surfaces made opaque.

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
struct TranslucentReceivers : PassTestOf<std::tuple<Blending, const char*>>
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
    this->scene.choose("silhouette edge_samples=1");
    this->steps->SetTranslucentPass(std::get<0>(GetParam()).pass());
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
}

INSTANTIATE_TEST_SUITE_P(, TranslucentReceivers,
  testing::Combine(blendings, testing::Values("sun", "spot")),
  [](const auto& made)
  { return std::string(std::get<0>(made.param).name) + "_" + std::get<1>(made.param); });

/// Panes one above the other, which receive and let light through, over a floor, seen from above.
struct GlassReceivers : PassTestOf<std::tuple<Blending, const char*, bool>>
{
  static constexpr int side = 64;

  GlassReceivers()
  {
    const bool isSun = std::string("sun") == std::get<1>(GetParam());
    isSun ? this->scene.addSun({ 0.2, 0.1, -1.0 })
          : this->scene.addSpot({ 0.3, -0.4, 9.0 }, { 0.0, 0.0, 0.0 }, 60.0);
    this->scene.addFloor(3.0, -0.3);
    this->scene.lookDown(0.6);
    this->scene.pass->TranslucentCastersOn();
    this->steps->SetTranslucentPass(std::get<0>(GetParam()).pass());
    this->scene.pass->SetDelegatePass(this->steps);
  }
  static bool isColoured() { return std::get<2>(GetParam()); }
  static double colourOf(int channel) { return isColoured() ? 0.4 + 0.25 * channel : 1.0; }
  /// Replace the panes; the first one is the lowest.
  void addPanes(int count, double opacity)
  {
    for (vtkActor* const pane : this->panes)
    {
      this->scene.renderer->RemoveActor(pane);
    }
    this->panes.clear();
    for (int i = 0; i < count; ++i)
    {
      vtkActor* const pane = this->scene.addFloor(2.0, 0.3 * i);
      pane->GetProperty()->SetOpacity(opacity);
      if (isColoured())
      {
        vtkGnomonPropKeys::SetTransmits(pane, vtkGnomonPropKeys::TRANSMITS_COLORED);
      }
      this->panes.push_back(pane);
    }
    this->setColours([](int, int) { return 1.0; });
  }
  /// Set the colours of floor and panes, scaled by channel and number of panes above.
  template <typename ScaleOf>
  void setColours(const ScaleOf& scaleOf)
  {
    const int all = static_cast<int>(this->panes.size());
    this->scene.floor()->GetProperty()->SetColor(scaleOf(0, all), scaleOf(1, all), scaleOf(2, all));
    for (std::size_t i = 0; i < this->panes.size(); ++i)
    {
      const int above = all - 1 - static_cast<int>(i);
      const auto at = [&](int channel) { return colourOf(channel) * scaleOf(channel, above); };
      this->panes[i]->GetProperty()->SetColor(at(0), at(1), at(2));
    }
  }

  PassScene scene{ side, side };
  std::vector<vtkActor*> panes;
  vtkNew<vtkRenderStepsPass> steps;
};

/// As VTK draws surfaces whose own colours are dark by what the panes above leave.
TEST_P(GlassReceivers, areDimmedByThePanesBeforeThem)
{
  this->scene.choose("raytraced");
  for (const int count : { 1, 2, 5 })
  {
    for (const double opacity : { 0.1, 0.5, 0.9 })
    {
      this->addPanes(count, opacity);
      const Picture shadowed = this->scene.render();
      this->setColours(
        [&](int channel, int above) {
          return std::pow(1.0 - opacity * (isColoured() ? 1.0 - colourOf(channel) : 1.0), above);
        });
      this->scene.renderer->SetPass(this->steps);
      const Picture truth = this->scene.render();
      this->scene.useGnomon();
      EXPECT_EQ(differingPixels(shadowed, truth, 2), 0u) << count << " of " << opacity;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, GlassReceivers,
  testing::Combine(blendings, testing::Values("sun", "spot"), testing::Bool()),
  [](const auto& made)
  {
    return std::string(std::get<0>(made.param).name) + "_" + std::get<1>(made.param) +
      (std::get<2>(made.param) ? "_stained" : "");
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
