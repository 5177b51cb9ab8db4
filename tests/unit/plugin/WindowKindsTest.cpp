// Windows of all kinds: the shadow is at its exact place, for every shape, tiling and owner of the
// window.

#include "PassScene.h"

#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

using namespace gnomon::test;

namespace
{

constexpr double extent = 10.0;

/// A box over a floor, whose shadow is x in [0, 4], y in [-1, 1].
class WindowKinds
  : public PassTest
  , public testing::WithParamInterface<Way>
{
protected:
  WindowKinds()
  {
    this->scene.addFloor(extent);
    this->box = this->scene.addBox(hangingBox.lower, hangingBox.upper);
    this->scene.addSun(slantingSun);
    this->scene.lookDown(5.0);
    this->scene.choose(GetParam());
  }

  void expectRight(const Picture& picture) const
  {
    const double band = 3.0 * 24.0 / 1024.0 + 10.0 / picture.height; // texels and a pixel
    const FloorCheck found =
      checkFloor(this->scene, picture, floorUnderSun(hangingBox, extent), band);
    EXPECT_GT(found.counted, picture.pixels() / 3);
    EXPECT_EQ(found.falseLight, 0u);
    EXPECT_EQ(found.falseShadow, 0u);
  }

  PassScene scene{ 300, 300 };
  vtkActor* box = nullptr;
};

INSTANTIATE_TEST_SUITE_P(Ways, WindowKinds, allWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnPlanes, WindowKinds, testing::Values(planarWay), nameOf);

/// Return x of the shadow's far end, which is at 4, on the middle row of a picture, in pixels.
int shadowEnd(const Picture& picture)
{
  int x = picture.width - 1;
  while (x > 0 && picture.red(x, picture.height / 2) > 0.5 * slantingSunValue)
  {
    --x;
  }
  return x;
}

} // namespace

//------------------------------------------------------------------------------
TEST_P(WindowKinds, AnyShapeAndSize)
{
  for (const auto& [width, height] :
    { std::pair(300, 300), std::pair(640, 200), std::pair(120, 360), std::pair(301, 299) })
  {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    this->scene.window->SetSize(width, height);
    this->expectRight(this->scene.render());
  }
}

//------------------------------------------------------------------------------
TEST_P(WindowKinds, TheShadowsEdgeIsAtTheSamePlaceInSmallAndWideWindows)
{
  for (const auto& [width, height] : { std::pair(600, 600), std::pair(1920, 1080) })
  {
    this->scene.window->SetSize(width, height);
    const double pixel = 10.0 / height;
    const double end = (shadowEnd(this->scene.render()) + 0.5 - 0.5 * width) * pixel;
    EXPECT_NEAR(end, 4.0, pixel + 24.0 / 1024.0) << width << " x " << height; // and a texel
  }
}

//------------------------------------------------------------------------------
TEST_P(WindowKinds, Tiles)
{
  // Nine renderings, each a third of the picture wide and high.
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(this->scene.window);
  filter->SetScale(3);
  filter->SetInputBufferTypeToRGB();
  filter->Update();
  vtkImageData* image = filter->GetOutput();
  Picture tiled;
  tiled.width = image->GetDimensions()[0];
  tiled.height = image->GetDimensions()[1];
  auto* values = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  tiled.rgb.assign(values->GetPointer(0), values->GetPointer(0) + values->GetNumberOfValues());
  ASSERT_EQ(tiled.width, 900);

  this->scene.window->SetSize(900, 900);
  const Picture whole = this->scene.render();
  this->expectRight(whole);
  EXPECT_LE(differingPixels(tiled, whole, 2), 20u); // where rounding moves an edge
  EXPECT_GT(
    differingPixels(tiled, Picture{ 900, 900, std::vector<unsigned char>(tiled.rgb.size()) }),
    100000u);
}

//------------------------------------------------------------------------------
/// In each eye's picture the shadow ends at the thin red line that is drawn at its end on the
/// floor.
TEST_P(WindowKinds, Stereo)
{
  this->scene.lookFrom({ 3.0, -12.0, 12.0 }, { 1.5, 0.0, 0.0 });
  this->scene.renderer->GetActiveCamera()->SetEyeAngle(8.0);
  vtkActor* line = this->scene.addBox({ 3.95, -0.9, 0.0 }, { 4.05, 0.9, 1e-3 });
  line->GetProperty()->SetLighting(false);
  line->GetProperty()->SetColor(1.0, 0.0, 0.0);
  this->scene.window->SetStereoRender(1);
  const auto drawAs = [&](int kind)
  {
    this->scene.window->SetStereoType(kind);
    return this->scene.render();
  };
  const auto expectShadowBesideTheLine = [](const Picture& picture)
  {
    int rows = 0;
    for (int y = 0; y < picture.height; ++y)
    {
      const auto isLine = [&](int x) { return picture.at(x, y) == glm::ivec3(255, 0, 0); };
      int first = 0;
      while (first < picture.width && !isLine(first))
      {
        ++first;
      }
      int last = first;
      while (last + 1 < picture.width && isLine(last + 1))
      {
        ++last;
      }
      if (first < 4 || last + 4 >= picture.width)
      {
        continue;
      }
      ++rows;
      EXPECT_LT(picture.red(first - 3, y), 40) << "row " << y;
      EXPECT_GT(picture.red(last + 3, y), 120) << "row " << y;
    }
    EXPECT_GT(rows, 10);
  };
  const Picture left = drawAs(VTK_STEREO_LEFT);
  const Picture right = drawAs(VTK_STEREO_RIGHT);
  EXPECT_GT(differingPixels(left, right), 1000u);
  expectShadowBesideTheLine(left);
  expectShadowBesideTheLine(right);
  expectShadowBesideTheLine(drawAs(VTK_STEREO_SPLITVIEWPORT_HORIZONTAL));
  for (const int kind : { VTK_STEREO_INTERLACED, VTK_STEREO_CHECKERBOARD, VTK_STEREO_DRESDEN })
  {
    // Every pixel belongs to one of the two eyes' pictures.
    const Picture mixed = drawAs(kind);
    int strange = 0;
    for (int y = 0; y < mixed.height; ++y)
    {
      for (int x = 0; x < mixed.width; ++x)
      {
        strange += mixed.at(x, y) != left.at(x, y) && mixed.at(x, y) != right.at(x, y) ? 1 : 0;
      }
    }
    EXPECT_EQ(strange, 0) << "kind " << kind;
  }
}

//------------------------------------------------------------------------------
TEST_P(WindowKinds, LayersOfRenderers)
{
  const Picture alone = this->scene.render();
  // Another renderer on top, with its own shadows, over a part of the window.
  vtkNew<vtkRenderer> above;
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SmoothTerminatorsOff();
  shadows->SetTechnique(GetParam().technique);
  shadows->SetRoute(GetParam().route);
  above->SetPass(shadows);
  above->SetLayer(1);
  this->scene.window->SetNumberOfLayers(2);
  this->scene.window->AddRenderer(above);
  EXPECT_EQ(differingPixels(alone, this->scene.render()), 0u); // the other renderer is empty

  PassScene other(300, 300);
  vtkActor* ball = other.addSphere({ -3.0, 3.0, 4.0 }, 1.0);
  above->AddActor(ball);
  above->SetActiveCamera(this->scene.renderer->GetActiveCamera());
  const Picture both = this->scene.render();
  std::size_t changed = 0;
  for (int y = 0; y < both.height; ++y)
  {
    for (int x = 0; x < both.width; ++x)
    {
      const glm::dvec2 floor = this->scene.floorAt(x, y);
      const bool onBall = glm::distance(floor, glm::dvec2(-3.0, 3.0)) < 1.05;
      changed += both.at(x, y) != alone.at(x, y) ? 1 : 0;
      EXPECT_TRUE(onBall || both.at(x, y) == alone.at(x, y)) << x << ", " << y;
    }
  }
  EXPECT_GT(changed, 1000u);
  this->scene.window->RemoveRenderer(above);
}
