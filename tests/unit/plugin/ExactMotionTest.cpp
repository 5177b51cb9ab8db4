// Exact techniques equal ray tracing while casters are deformed, moved, split, removed and
// restored: no cached data of casters are stale.

#include "PassScene.h"
#include "Variant.h"

#include <vtkCell.h>
#include <vtkShrinkPolyData.h>

namespace gnomon::test
{
namespace
{

struct ExactInMotion : PassTestOf<Variant>
{
  ExactInMotion()
  {
    this->scene.addFloor(4.0);
    this->ball = this->scene.add(this->ballShape.Get());
    const auto open = ballOf(glm::dvec3(0.0), 0.5, 24, 12);
    open->SetEndPhi(100.0);
    vtkNew<vtkShrinkPolyData> torn; // each triangle has corners of its own
    torn->SetInputConnection(open->GetOutputPort());
    torn->SetShrinkFactor(1.0);
    this->cupShape = copyOf(torn);
    this->cup = this->scene.add(this->cupShape.Get());
    // Two surfaces that meet in an edge.
    for (std::size_t side = 0; side < 2; ++side)
    {
      const double from = side == 0 ? -1.0 : 0.0;
      this->sheetShapes[side] =
        copyOf(planeOf({ from, -0.8, 1.6 }, { from + 1.0, -0.8, 1.6 }, { from, 0.8, 1.6 }, 6));
      this->sheets[side] = this->scene.add(this->sheetShapes[side].Get());
    }
    this->sun = this->scene.addSun({ -1.0, -0.4, -2.0 });
    this->lamp = this->scene.addSpot({ -1.5, -1.0, 3.0 }, { 0.0, 0.0, 0.0 }, 80.0);
    this->scene.lookFrom({ 0.0, -9.0, 7.0 }, { 0.0, 0.0, 0.3 });

    this->truth->SetTechnique("raytraced");
    this->truth->KeepVisibilityOn();
    this->truth->SmoothTerminatorsOff();
    this->scene.pass->SetMapSize(256);
    GetParam().choose(this->scene); // one pass through all changes
    this->scene.pass->KeepVisibilityOn();
  }

  /// Return a random number from -1 to 1.
  double some() { return std::uniform_real_distribution<double>(-1.0, 1.0)(this->random); }

  static void putBack(vtkPolyData* shape, vtkPoints* corners)
  {
    shape->GetPoints()->DeepCopy(corners);
    shape->GetPoints()->Modified();
  }
  static vtkSmartPointer<vtkPoints> cornersOf(vtkPolyData* shape)
  {
    const auto corners = vtkSmartPointer<vtkPoints>::New();
    corners->DeepCopy(shape->GetPoints());
    return corners;
  }

  /// Remove the first of a shape's cells and reverse the order of the others.
  static void changeCells(vtkPolyData* shape)
  {
    vtkNew<vtkCellArray> cells;
    for (vtkIdType cell = shape->GetNumberOfCells() - 1; cell > 0; --cell)
    {
      cells->InsertNextCell(shape->GetCell(cell)->GetPointIds());
    }
    shape->SetPolys(cells);
  }

  /// Compare the technique with ray tracing.
  void expectTruth(const std::string& after)
  {
    this->truth->ReleaseGraphicsResources(this->scene.window); // so that it reuses nothing
    this->scene.renderer->SetPass(this->truth);
    this->scene.window->Render();
    const std::vector<std::vector<float>> traced = this->truth->GetVisibility().visibility;
    this->scene.useGnomon();
    this->scene.render();
    const std::vector<std::vector<float>>& shown = this->scene.pass->GetVisibility().visibility;
    ASSERT_EQ(traced.size(), 2u);
    ASSERT_EQ(shown.size(), traced.size());
    for (std::size_t light = 0; light < traced.size(); ++light)
    {
      EXPECT_EQ(countDifferences(shown[light], traced[light]), 0u) << after << ", light " << light;
      const LightReport& report = this->scene.report().lights[light];
      EXPECT_GT(report.mapSizeTexels, 0) << after;
      this->rays += report.tracedPixels;
      this->raysOfTruth += this->truth->GetReport().lights[light].tracedPixels;
    }
  }

  PassScene scene{ 160, 128 };
  vtkNew<vtkGnomonShadowPass> truth;
  vtkSmartPointer<vtkPolyData> ballShape = copyOf(ballOf(glm::dvec3(0.0), 0.7, 32, 20));
  vtkSmartPointer<vtkPolyData> cupShape;
  std::array<vtkSmartPointer<vtkPolyData>, 2> sheetShapes;
  vtkActor* ball;
  vtkActor* cup;
  std::array<vtkSmartPointer<vtkActor>, 2> sheets; // owned here, since the renderer may drop them
  vtkLight* sun;
  vtkLight* lamp;
  std::mt19937 random;
  std::size_t rays = 0;
  std::size_t raysOfTruth = 0;
};

TEST_P(ExactInMotion, showsWhatIsTraced)
{
  for (int round = 0; round < 3; ++round)
  {
    this->expectTruth("at rest");
    const auto ballCorners = cornersOf(this->ballShape), cupCorners = cornersOf(this->cupShape);
    const auto jitter = [this](const glm::dvec3& point)
    { return point + 0.02 * glm::dvec3(this->some(), this->some(), this->some()); };
    movePoints(this->ballShape, jitter);
    movePoints(this->cupShape, jitter);
    this->expectTruth("points moved, some surfaces torn");
    const auto merge = [](const glm::dvec3& point) { return glm::round(8.0 * point) / 8.0; };
    movePoints(this->ballShape, merge);
    movePoints(this->cupShape, merge);
    this->expectTruth("points merged");
    putBack(this->ballShape, ballCorners);
    putBack(this->cupShape, cupCorners);
    this->expectTruth("points put back");

    this->ball->SetPosition(this->some(), this->some(), 0.8 + 0.5 * this->some());
    this->ball->RotateX(20.0);
    this->cup->SetPosition(this->some(), this->some(), 1.0 + 0.4 * this->some());
    this->cup->SetScale(1.0, 1.0, 1.0 + 0.3 * this->some());
    this->expectTruth("actors moved");
    changeCells(this->ballShape);
    this->expectTruth("cells changed");

    const double height = 0.3 * this->some();
    for (vtkPolyData* sheet : this->sheetShapes)
    {
      movePoints(sheet,
        [height](const glm::dvec3& point)
        { return glm::dvec3(point.x, point.y, 1.6 + height * std::sin(3.0 * point.x)); });
    }
    this->expectTruth("both sides of a seam bent");
    this->sheets[1]->SetPosition(0.1, 0.0, 0.0);
    this->expectTruth("seam opened");
    this->sheets[1]->SetPosition(0.0, 0.0, 0.0);
    this->expectTruth("seam closed");

    this->sun->SetPosition(1.0 + this->some(), this->some(), 2.0);
    this->lamp->SetPosition(-1.5 + this->some(), -1.0, 3.0);
    this->expectTruth("lights moved");

    this->scene.renderer->RemoveActor(this->sheets[0]);
    this->expectTruth("one side of a seam taken away");
    this->scene.renderer->AddActor(this->sheets[0]);
    this->expectTruth("put back");
  }
  EXPECT_LT(this->rays, this->raysOfTruth) << "maps decide something";
}

INSTANTIATE_TEST_SUITE_P(Techniques, ExactInMotion,
  testing::Values(Variant{ "crsm" }, Variant{ "crsma" }, Variant{ "crsma adjacency_ring=vertices" },
    Variant{ "silhouette" }, Variant{ "silhouette fit=frame" },
    Variant{ "selective coherence=off contour=image" }),
  nameOfVariant);

} // namespace
} // namespace gnomon::test
