#include "plugin/vtkGnomonVisibilityFilter.h"

#include "DataMeshes.h"
#include "RandomScenes.h"
#include "VtkMessages.h"

#include "lights/vtkGnomonLightKeys.h"
#include "lights/vtkGnomonSun.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

namespace gnomon::test
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using Filter = vtkGnomonVisibilityFilter;
using Doubles = std::vector<double>;

/// All arrays of a result.
using Arrays = std::vector<Doubles>;
Arrays allArrays(Filter* filter)
{
  Arrays arrays;
  for (const char* name : { Filter::GetLitFractionName(), Filter::GetLitFractionErrorName(),
         Filter::GetHoursName(), Filter::GetBitsName(), Filter::GetWhyName(),
         Filter::GetBlockerName(), Filter::GetBlockerInputName() })
  {
    arrays.push_back(arrayOf(filter, name));
  }
  return arrays;
}

std::vector<glm::dvec3> someDirections(int count)
{
  Random random(3);
  std::vector<glm::dvec3> directions(static_cast<std::size_t>(count));
  std::generate(directions.begin(), directions.end(), [&random] { return unitVector(random); });
  return directions;
}

void addDirections(Filter* filter, int count, double hours = 1.0)
{
  for (const glm::dvec3& direction : someDirections(count))
  {
    filter->AddDirection(&direction.x, hours);
  }
}

struct VisibilityFilter : testing::Test
{
  void TearDown() override { EXPECT_EQ(this->messages.errors().size(), this->errorsTaken); }
  void expectError(const char* text)
  {
    ASSERT_EQ(this->messages.errors().size(), ++this->errorsTaken) << text;
    EXPECT_THAT(this->messages.errors().back(), HasSubstr(text));
  }
  Doubles fraction() { return arrayOf(this->filter, Filter::GetLitFractionName()); }
  /// Without an update.
  Doubles shown() { return shownArrayOf(this->filter, Filter::GetLitFractionName()); }
  Doubles why() { return arrayOf(this->filter, Filter::GetWhyName()); }
  Doubles blocker() { return arrayOf(this->filter, Filter::GetBlockerName()); }
  Doubles blockerInput() { return arrayOf(this->filter, Filter::GetBlockerInputName()); }
  /// Hills with a ball above them, under suns from all around.
  void useHills(int suns)
  {
    this->filter->SetInputData(polyData(makeTerrain(10.0, 24, 2.0)));
    this->filter->AddInputData(1, polyData(makeSphere(12, 24), { 0.0, 0.0, 2.5 }));
    addDirections(this->filter, suns, 0.5);
  }

  vtkNew<Filter> filter;
  tool::VtkMessages messages;
  std::size_t errorsTaken = 0;
};

TEST_F(VisibilityFilter, ExplainsLightsAndNamesBlockers)
{
  // A floor of four cells and a wall on it, which is the receivers' cell 4.
  this->filter->SetInputData(together({ floorOf({ 0, 0 }, { 2, 2 }, 2),
    quad({ 1.9, 0, 0 }, { 1.9, 1, 0 }, { 1.9, 1, 4 }, { 1.9, 0, 4 }) }));
  this->filter->AddInputData(1, quad({ 20, 0, 0 }, { 21, 0, 0 }, { 21, 1, 0 }, { 20, 1, 0 }));
  this->filter->AddInputData(1,
    together({ floorOf({ 30, 0 }, { 31, 1 }, 1),
      quad({ 0, 1, 6 }, { 9, 1, 6 }, { 9, 2, 6 }, { 0, 2, 6 }) }));
  this->filter->AddDirection(-1.0, 0.0, 0.0); // along the floor
  this->filter->AddDirection(1.0, 0.0, 1.0);
  this->filter->AddDirection(0.0, 0.0, -1.0);
  this->filter->SetExplainedLight(1);
  this->filter->SetUp(0.0, 0.0, 2.0);
  EXPECT_THAT(this->why(),
    ElementsAre(Filter::SELF, Filter::SELF, Filter::OTHER, Filter::OTHER, Filter::LIT));
  EXPECT_THAT(this->blocker(), ElementsAre(4, 4, 1, 1, -1));
  EXPECT_THAT(this->blockerInput(), ElementsAre(0, 0, 2, 2, -1));
  EXPECT_THAT(this->fraction(), ElementsAre(0, 0, 0, 0, testing::DoubleNear(1.0 / 3.0, 1e-6)));

  this->filter->SetReceiversCast(false);
  EXPECT_THAT(
    this->why(), ElementsAre(Filter::LIT, Filter::LIT, Filter::OTHER, Filter::OTHER, Filter::LIT));

  this->filter->SetExplainedLight(0);
  EXPECT_THAT(this->why(), testing::Each(Filter::BELOW_HORIZON));
  this->filter->SetUp(0.0, 0.0, 0.0);
  EXPECT_THAT(this->why(), testing::Each(Filter::TURNED_AWAY));
  this->filter->SetExplainedLight(-1);
  EXPECT_THAT(this->why(), testing::Each(Filter::TURNED_AWAY));
  this->filter->ComputeReasonsOff();
  EXPECT_TRUE(this->why().empty());
  EXPECT_EQ(this->fraction().size(), 5u);
}

TEST_F(VisibilityFilter, CellsKeepTheirNumbers)
{
  // A vertex, a line, a triangle, a cell without area and a strip of two triangles. The strip's
  // second triangle is under a roof.
  vtkNew<vtkPoints> points;
  for (const glm::dvec3& point : std::initializer_list<glm::dvec3>{ { 0, 0, 0 }, { 1, 0, 0 },
         { 0, 1, 0 }, { 10, 0, 0 }, { 11, 0, 0 }, { 10, 1, 0 }, { 11, 1, 0 } })
  {
    points->InsertNextPoint(point.x, point.y, point.z);
  }
  const auto cells = [](std::initializer_list<std::initializer_list<vtkIdType>> of)
  {
    auto array = vtkSmartPointer<vtkCellArray>::New();
    for (const auto& cell : of)
    {
      array->InsertNextCell(cell);
    }
    return array;
  };
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells({ { 0 } }));
  data->SetLines(cells({ { 0, 1 } }));
  data->SetPolys(cells({ { 0, 1, 2 }, { 0, 1, 0 } }));
  data->SetStrips(cells({ { 3, 4, 5, 6 } }));
  this->filter->SetInputData(data);
  this->filter->AddInputData(1, quad({ 10.7, -1, 1 }, { 12, -1, 1 }, { 12, 2, 1 }, { 10.7, 2, 1 }));
  this->filter->AddDirection(0.0, 0.0, 1.0);
  this->filter->SetSamples(256);
  EXPECT_THAT(this->fraction(), ElementsAre(0, 0, 1, 0, testing::DoubleNear(0.7, 0.01)));
  EXPECT_THAT(this->why(),
    ElementsAre(
      Filter::NO_SURFACE, Filter::NO_SURFACE, Filter::LIT, Filter::NO_SURFACE, Filter::LIT));
  // Blockers' numbers count all cells, too.
  this->filter->ClearLights();
  this->filter->AddDirection(0.0, 0.0, -1.0);
  this->filter->SetReceivingSide(Filter::BACK);
  this->filter->SetInputData(quad({ 10, 0, 2 }, { 11, 0, 2 }, { 11, 1, 2 }, { 10, 1, 2 }));
  this->filter->SetInputDataObject(1, data);
  EXPECT_THAT(this->blocker(), ElementsAre(4));
  EXPECT_THAT(this->blockerInput(), ElementsAre(1));
}

TEST_F(VisibilityFilter, SidesReceive)
{
  this->filter->SetInputData(floorOf({ 0, 0 }, { 1, 1 }, 1));
  this->filter->AddDirection(0.0, 0.1, 1.0, 1.0);
  this->filter->AddDirection(0.0, 0.1, -1.0, 3.0);
  EXPECT_THAT(this->fraction(), ElementsAre(0.25));
  this->filter->SetReceivingSide(Filter::BACK);
  EXPECT_THAT(this->fraction(), ElementsAre(0.75));
  this->filter->SetReceivingSide(Filter::BOTH);
  EXPECT_THAT(this->fraction(), ElementsAre(1.0));
}

TEST_F(VisibilityFilter, ConesAndBoxesEnd)
{
  this->filter->SetInputData(floorOf({ -2, -2 }, { 2, 2 }, 4));
  vtkNew<vtkLight> spot;
  spot->PositionalOn();
  spot->SetConeAngle(25.0); // holds the four cells in the middle
  spot->SetPosition(0.0, 0.0, 2.0);
  spot->SetFocalPoint(0.0, 0.0, 0.0);
  this->filter->AddLight(spot);
  const auto expectMiddle = [this]
  {
    const Doubles fraction = this->fraction();
    const Doubles why = this->why();
    for (int cell = 0; cell < 16; ++cell)
    {
      const int row = cell / 4;
      const bool isMiddle = std::abs(cell % 4 - 1.5) < 1.0 && std::abs(row - 1.5) < 1.0;
      EXPECT_EQ(fraction[cell], isMiddle ? 1.0 : 0.0) << cell;
      EXPECT_EQ(why[cell], isMiddle ? Filter::LIT : Filter::OUT_OF_REACH) << cell;
    }
  };
  expectMiddle();

  vtkNew<vtkLight> window;
  window->SetPosition(0.0, 0.0, 2.0);
  window->SetFocalPoint(0.0, 0.0, 0.0);
  const double up[3] = { 0.0, 1.0, 0.0 };
  vtkGnomonLightKeys::SetBox(window, 1.8, 1.8, 3.0, up);
  this->filter->ClearLights();
  this->filter->AddLight(window);
  expectMiddle();
  window->SetFocalPoint(0.0, 0.0, 4.0); // a light that moves makes results stale
  EXPECT_THAT(this->why(), testing::Each(Filter::TURNED_AWAY));
}

TEST_F(VisibilityFilter, PointsAreLitThroughAnyOfTheirCells)
{
  // A floor with a wall across it, at x = 0, which faces +x.
  this->filter->SetInputData(together({ floorOf({ 0, -1 }, { 2, 1 }, 2),
    quad({ 0, -1, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, -1, 1 }) }));
  this->filter->SetElementsToPoints();
  this->filter->AddDirection(-1.0, 0.0, 0.8);
  this->filter->Update();
  // Behind the wall the shadow ends at x = 1.25: the foot and the middle row lie in it.
  const Doubles behind = this->fraction();
  ASSERT_EQ(behind.size(), 13u);
  for (int point = 0; point < 9; ++point)
  {
    EXPECT_EQ(behind[point], point % 3 == 2 ? 1.0 : 0.0) << point;
  }
  EXPECT_THAT(Doubles(behind.begin() + 9, behind.end()), testing::Each(0.0));
  EXPECT_EQ(this->why()[9], Filter::TURNED_AWAY);
  EXPECT_EQ(this->why()[3], Filter::SELF);
  EXPECT_EQ(this->blocker()[3], 4);

  this->filter->ClearLights();
  this->filter->AddDirection(1.0, 0.0, 0.01);
  EXPECT_THAT(this->fraction(), testing::Each(1.0));
  // At the foot of a thin wall, the floor behind it is dark and the floor in front of it is lit.
  this->filter->SetInputData(together({ floorOf({ -1, -1 }, { 1, 1 }, 2),
    quad({ 0, -1, 0 }, { 0, -1, 1 }, { 0, 1, 1 }, { 0, 1, 0 }) }));
  this->filter->ClearLights();
  for (const double x : { -0.8, 0.8 })
  {
    this->filter->AddDirection(x, 0.0, 1.0);
  }
  EXPECT_EQ(this->fraction()[4], 1.0);
  // A corner of a cube is lit if one of its faces is.
  this->filter->ClearLights();
  this->filter->SetInputData(polyData(makeBox({ 0, 0, 0 }, { 1, 1, 1 })));
  this->filter->AddDirection(0.0, 0.0, 1.0);
  this->filter->Update();
  vtkPoints* points = this->filter->GetOutput()->GetPoints();
  const Doubles corners = this->fraction();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(corners[static_cast<std::size_t>(i)], points->GetPoint(i)[2]) << i;
  }
}

TEST_F(VisibilityFilter, BitsAreThoseOfEachLightAlone)
{
  this->useHills(37);
  this->filter->ComputeBitsOn();
  vtkNew<vtkLight> lamp; // among the directions
  lamp->PositionalOn();
  lamp->SetConeAngle(90.0);
  lamp->SetPosition(1.0, 2.0, 4.0);
  this->filter->AddLight(lamp);
  this->filter->AddDirection(0.3, 0.2, 1.0);
  const Doubles bits = arrayOf(this->filter, Filter::GetBitsName());
  const Doubles hours = arrayOf(this->filter, Filter::GetHoursName());
  const std::size_t cells = hours.size();
  ASSERT_EQ(bits.size(), cells * 5);
  const auto isLit = [&](std::size_t cell, std::size_t light)
  { return (static_cast<unsigned int>(bits[cell * 5 + light / 8]) >> light % 8 & 1u) != 0; };

  std::vector<glm::dvec3> directions = someDirections(37);
  for (std::size_t light = 0; light < 39; ++light)
  {
    vtkNew<Filter> alone;
    alone->SetInputData(vtkPolyData::SafeDownCast(this->filter->GetInput()));
    alone->AddInputData(1, this->filter->GetInputDataObject(1, 0));
    light == 37    ? alone->AddLight(lamp)
      : light < 37 ? alone->AddDirection(&directions[light].x)
                   : alone->AddDirection(0.3, 0.2, 1.0);
    alone->Update();
    const Doubles fraction = arrayOf(alone, Filter::GetLitFractionName());
    for (std::size_t cell = 0; cell < cells; ++cell)
    {
      ASSERT_EQ(isLit(cell, light), fraction[cell] == 1.0) << cell << ", " << light;
    }
  }
  std::size_t lit = 0;
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    double expected = 0.0;
    for (std::size_t light = 0; light < 39; ++light)
    {
      expected += isLit(cell, light) ? (light < 37 ? 0.5 : 1.0) : 0.0;
      lit += isLit(cell, light) ? 1 : 0;
    }
    EXPECT_NEAR(hours[cell], expected, 1e-5);
    EXPECT_EQ(bits[cell * 5 + 4] >= 128.0, false); // there is no light 39
  }
  EXPECT_GT(lit, cells * 5);
  EXPECT_LT(lit, cells * 30);
}

TEST_F(VisibilityFilter, AbortedExecutionsGoOn)
{
  // Use several chunks of samples, and in the last one several blocks of lights.
  this->filter->SetInputData(polyData(makeTerrain(10.0, 60, 2.0)));
  this->filter->SetSamples(4);
  this->filter->ComputeBitsOn();
  std::vector<double> shares;
  {
    const Progress progress(this->filter, [&](double share) { shares.push_back(share); });
    addDirections(this->filter, 300);
    this->filter->Update();
  }
  EXPECT_GT(shares.size(), 3u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
  const Arrays straight = allArrays(this->filter);
  const vtkTypeInt64 rays = this->filter->GetNumberOfRays();

  this->filter->ClearLights();
  addDirections(this->filter, 300);
  int aborts = 0;
  for (bool isDone = false; !isDone && aborts < 50;)
  {
    int told = 0;
    const Progress progress(this->filter,
      [&](double share)
      {
        if (share > 0.0 && share < 1.0 && ++told == 1)
        {
          this->filter->AbortExecuteOn();
        }
      });
    this->filter->Update();
    isDone = !this->shown().empty();
    aborts += isDone ? 0 : 1;
    if (!isDone)
    {
      EXPECT_LT(this->filter->GetNumberOfRays(), rays);
      EXPECT_EQ(this->filter->GetOutput()->GetNumberOfCells(), 7200);
    }
  }
  EXPECT_GT(aborts, 1);
  EXPECT_EQ(allArrays(this->filter), straight);
  EXPECT_EQ(this->filter->GetNumberOfRays(), rays); // none was traced twice
  const vtkMTimeType done = this->filter->GetMTime();
  EXPECT_EQ(this->filter->GetMTime(), done);
}

TEST_F(VisibilityFilter, ChangesAfterAnAbortBeginAnew)
{
  this->useHills(20);
  const auto abort = [&]
  {
    const Progress progress(this->filter, [&](double) { this->filter->AbortExecuteOn(); });
    this->filter->SetInputData(polyData(makeTerrain(10.0, 100, 2.0)));
    this->filter->Update();
    EXPECT_TRUE(this->shown().empty());
  };
  abort();
  this->filter->SetSamples(2);
  this->filter->Update();
  const Arrays arrays = allArrays(this->filter);
  vtkNew<Filter> fresh;
  fresh->SetInputData(vtkPolyData::SafeDownCast(this->filter->GetInput()));
  fresh->AddInputData(1, this->filter->GetInputDataObject(1, 0));
  addDirections(fresh, 20, 0.5);
  fresh->SetSamples(2);
  fresh->Update();
  EXPECT_EQ(arrays, allArrays(fresh));
}

TEST_F(VisibilityFilter, OnlyWhatChangedIsTracedAgain)
{
  vtkNew<vtkPolyData> data;
  data->ShallowCopy(floorOf({ 0, 0 }, { 2, 2 }, 2));
  this->filter->SetInputData(data);
  this->filter->AddDirection(0.0, 0.0, 1.0);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfRays(), 4);
  const void* const array = this->filter->GetOutput()->GetCellData()->GetArray("LitFraction");
  vtkNew<vtkFloatArray> colours;
  colours->SetName("Colours");
  colours->SetNumberOfTuples(4);
  data->GetCellData()->AddArray(colours);
  this->filter->Update(); // new colours change no shape
  EXPECT_EQ(this->filter->GetOutput()->GetCellData()->GetArray("LitFraction"), array);
  EXPECT_TRUE(this->filter->GetOutput()->GetCellData()->HasArray("Colours"));

  this->filter->AddInputData(1, quad({ 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 }));
  this->filter->Update();
  EXPECT_THAT(this->shown(), ElementsAre(0, 1, 1, 1));
  for (vtkIdType i = 0; i < 9; ++i)
  {
    const double* at = data->GetPoint(i);
    data->GetPoints()->SetPoint(i, at[0] - 1.0, at[1], at[2]);
  }
  data->GetPoints()->Modified();
  this->filter->Update();
  EXPECT_THAT(this->shown(), ElementsAre(1, 0, 1, 1));
  this->filter->RemoveAllInputConnections(1);
  this->filter->Update();
  EXPECT_THAT(this->shown(), testing::Each(1.0));
  // The input receivers get no new arrays.
  EXPECT_EQ(data->GetCellData()->GetNumberOfArrays(), 1);
}

TEST_F(VisibilityFilter, ChangesOfLightsAreTraced)
{
  vtkNew<vtkLight> light;
  light->SetPosition(0.0, 0.0, 5.0);
  vtkNew<vtkMatrix4x4> matrix;
  light->SetTransformMatrix(matrix);
  const vtkSmartPointer<vtkPolyData> floor = floorOf({ -2, -2 }, { 2, 2 }, 8);
  this->filter->SetInputData(floor);
  this->filter->AddInputData(1, quad({ 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 }));
  this->filter->AddLight(light);
  const double up[3] = { 0.0, 1.0, 0.0 };
  const std::pair<const char*, std::function<void()>> changes[] = {
    { "box", [&] { vtkGnomonLightKeys::SetBox(light, 3.0, 2.0, 9.0, up); } },
    { "another box", [&] { vtkGnomonLightKeys::SetBox(light, 2.0, 3.0, 9.0, up); } },
    { "matrix in place", [&] { matrix->SetElement(0, 3, 1.0); } },
    { "no box", [&] { vtkGnomonLightKeys::RemoveBox(light); } },
    { "place", [&] { light->SetPosition(1.0, 1.0, 4.0); } },
    { "kind", [&] { light->PositionalOn(); } },
    { "cone", [&] { light->SetConeAngle(12.0); } },
    { "no matrix", [&] { light->SetTransformMatrix(nullptr); } },
  };
  Doubles before = this->fraction();
  for (const auto& [what, change] : changes)
  {
    change();
    this->filter->Update();
    vtkNew<Filter> fresh;
    fresh->SetInputData(floor);
    fresh->AddInputData(1, this->filter->GetInputDataObject(1, 0));
    fresh->AddLight(light);
    fresh->Update();
    const Doubles now = this->fraction();
    EXPECT_EQ(now, arrayOf(fresh, Filter::GetLitFractionName())) << what;
    EXPECT_NE(now, std::exchange(before, now)) << what;
  }
}

TEST_F(VisibilityFilter, ScenesMayBeFarAwayAndOfAnySize)
{
  this->useHills(30);
  const Doubles near = this->fraction();
  std::size_t different = 0;
  for (const double scale : { 1e-5, 1.0, 1e6 })
  {
    const glm::dvec3 by(scale * 1e6, -scale * 3e6, scale * 1e3);
    const auto placed = [&](Mesh mesh, const glm::dvec3& at)
    {
      for (glm::dvec3& point : mesh.points)
      {
        point = scale * (point + at);
      }
      return polyData(mesh, by);
    };
    vtkNew<Filter> far;
    far->SetInputData(placed(makeTerrain(10.0, 24, 2.0), glm::dvec3(0.0)));
    far->AddInputData(1, placed(makeSphere(12, 24), { 0.0, 0.0, 2.5 }));
    addDirections(far, 30);
    far->Update();
    const Doubles fraction = arrayOf(far, Filter::GetLitFractionName());
    ASSERT_EQ(fraction.size(), near.size());
    for (std::size_t i = 0; i < near.size(); ++i)
    {
      different += std::abs(fraction[i] - near[i]) > 1e-6 ? 1 : 0;
    }
  }
  // Of 100,000 rays, some meet edges to within rounding.
  EXPECT_LE(different, 20u);
}

TEST_F(VisibilityFilter, BrokenGeometryIsLeftOut)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  this->filter->AddDirection(0.0, 0.0, 1.0);
  for (const double far : { 1.3e30, -3.4028235e38, 1e300 })
  {
    this->filter->SetInputData(
      polyData({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { nan, 1, 0 }, { far, 0, 0 } },
        { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 4, 2 } } }));
    EXPECT_THAT(this->why(), ElementsAre(Filter::LIT, Filter::NO_SURFACE, Filter::NO_SURFACE));
    EXPECT_THAT(this->fraction(), ElementsAre(1, 0, 0));
  }
  this->filter->SetElementsToPoints();
  EXPECT_THAT(this->fraction(), ElementsAre(1, 1, 1, 0, 0));

  // No input at all is no error.
  this->filter->SetInputData(vtkNew<vtkPolyData>());
  EXPECT_TRUE(this->fraction().empty());
  this->filter->SetElementsToCells();
  EXPECT_TRUE(this->fraction().empty());
  this->filter->SetInputData(floorOf({ 0, 0 }, { 1, 1 }, 1));
  this->filter->AddInputData(1, vtkNew<vtkPolyData>());
  EXPECT_THAT(this->fraction(), ElementsAre(1));
  // Lights without hours, or all below the horizon, are no error either.
  this->filter->ClearLights();
  this->filter->AddDirection(0.0, 0.0, 1.0, 0.0);
  EXPECT_THAT(this->fraction(), ElementsAre(0));
  EXPECT_THAT(this->why(), ElementsAre(Filter::LIT));
  this->filter->SetUp(0.0, 0.0, -1.0);
  EXPECT_THAT(this->why(), ElementsAre(Filter::BELOW_HORIZON));
  // Within the world, where coordinates' squares are no floats.
  this->filter->SetUp(0.0, 0.0, 1.0);
  this->filter->SetInputData(floorOf({ 0, 0 }, { 1e25, 1e25 }, 1));
  this->filter->AddInputData(
    1, quad({ 0, 0, 1e24 }, { 1e25, 0, 1e24 }, { 1e25, 1e25, 1e24 }, { 0, 1e25, 1e24 }));
  EXPECT_THAT(this->why(), ElementsAre(Filter::OTHER));
}

TEST_F(VisibilityFilter, InvalidInputIsAnErrorAndChangesNothing)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  this->filter->SetInputData(floorOf({ 0, 0 }, { 1, 1 }, 1));
  this->filter->Update();
  this->expectError("no directions, suns or lights");
  EXPECT_EQ(this->filter->GetOutput()->GetNumberOfCells(), 1);
  EXPECT_TRUE(this->shown().empty());

  vtkNew<vtkDoubleArray> directions;
  directions->SetNumberOfComponents(3);
  directions->InsertNextTuple3(0.0, 0.0, 1.0);
  directions->InsertNextTuple3(0.0, 0.0, nan);
  vtkNew<vtkDoubleArray> hours;
  hours->InsertNextValue(1.0);
  vtkNew<vtkGnomonSun> sun;
  const std::pair<const char*, std::function<void()>> calls[] = {
    { "Direction 0 (0, 0, 0)", [&] { this->filter->AddDirection(0.0, 0.0, 0.0); } },
    { "nan", [&] { this->filter->AddDirection(0.0, nan, 1.0); } },
    { "-2 hours", [&] { this->filter->AddDirection(0.0, 0.0, 1.0, -2.0); } },
    { "Tuple 1", [&] { this->filter->AddDirections(directions); } },
    { "hours of 2 directions", [&] { this->filter->AddDirections(directions, hours); } },
    { "Up was to be (nan", [&] { this->filter->SetUp(nan, 0.0, 0.0); } },
    { "stepMinutes was to be -5", [&] { this->filter->AddSunDay(sun, -5.0); } },
  };
  for (const auto& [text, call] : calls)
  {
    call();
    this->expectError(text);
  }
  EXPECT_EQ(this->filter->GetNumberOfLights(), 0);
  EXPECT_EQ(this->filter->GetUp()[2], 0.0);

  this->filter->AddDirection(0.0, 0.0, 1.0);
  this->filter->SetExplainedLight(1);
  this->filter->Update();
  this->expectError("explained light 1");
  this->filter->SetExplainedLight(-1);
  vtkNew<vtkLight> light;
  light->SetPosition(1.0, 1.0, 1.0);
  light->SetFocalPoint(1.0, 1.0, 1.0);
  this->filter->AddLight(light);
  this->filter->Update();
  this->expectError("light 1: its position and focal point give no direction");
  EXPECT_TRUE(this->shown().empty());
  light->SetPosition(1.0, 1.0, 2.0);
  this->filter->Update();
  EXPECT_THAT(this->shown(), ElementsAre(1));
}

} // namespace
} // namespace gnomon::test
