// Compare vtkGnomonVisibilityFilter with shadows known in closed form.

#include "DataMeshes.h"
#include "VtkMessages.h"
#include "truth/HalfPlane.h"

#include "lights/vtkGnomonSun.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <vtkLight.h>
#include <vtkNew.h>

#include <cmath>
#include <cstddef>
#include <numeric>

namespace gnomon::test
{
namespace
{

using Filter = vtkGnomonVisibilityFilter;

struct ClosedForms : testing::Test
{
  void TearDown() override { EXPECT_TRUE(this->messages.errors().empty()); }

  vtkNew<Filter> filter;
  tool::VtkMessages messages;
};

/// Suns circle in the plane y = 0. A half plane over x < 0 at height 1 hides those between its edge
/// and the horizon at -x.
TEST_F(ClosedForms, AHalfPlaneHidesSunsBetweenItsEdgeAndTheHorizon)
{
  constexpr int cells = 24;
  const double far = 1e5;
  this->filter->SetInputData(floorOf({ -3.0, -1.0 }, { 3.0, 1.0 }, cells));
  this->filter->AddInputData(
    1, quad({ -far, -far, 1.0 }, { 0.0, -far, 1.0 }, { 0.0, far, 1.0 }, { -far, far, 1.0 }));
  constexpr int suns = 4000;
  for (int i = 0; i < suns; ++i)
  {
    const double angle = glm::pi<double>() * (i + 0.5) / suns;
    this->filter->AddDirection(std::cos(angle), 0.0, std::sin(angle), 12.0 / suns);
  }
  const std::vector<double> fraction = arrayOf(this->filter, Filter::GetLitFractionName());
  const std::vector<double> hours = arrayOf(this->filter, Filter::GetHoursName());
  ASSERT_EQ(fraction.size(), cells * cells);
  for (int cell = 0; cell < cells * cells; ++cell)
  {
    const double x = -3.0 + 6.0 * (cell % cells + 0.5) / cells;
    const double expected = std::atan2(1.0, -x) / glm::pi<double>();
    EXPECT_NEAR(fraction[cell], expected, 0.005 * expected) << x;
    EXPECT_NEAR(hours[cell], 12.0 * expected, 0.06 * expected) << x;
  }
}

/// The edge of the half plane cuts a cell in two.
TEST_F(ClosedForms, AnEdgeCutsACell)
{
  const double far = 1e3;
  this->filter->SetInputData(quad({ 0, 0, 0 }, { 1, 0, 0 }, { 1.5, 1, 0 }, { 0, 1, 0 }));
  this->filter->AddInputData(
    1, quad({ -far, -far, 1 }, { 0.3, -far, 1 }, { 0.3, far, 1 }, { -far, far, 1 }));
  this->filter->SetSamples(1024);
  this->filter->AddDirection(-0.1, 0.0, 1.0); // lit where x > 0.4
  const double area = 1.25;
  const double expected = (area - 0.4) / area;
  const double fraction = arrayOf(this->filter, Filter::GetLitFractionName()).front();
  EXPECT_NEAR(fraction, expected, 0.005 * expected);
  // A fair coin's standard deviation. It bounds the error of even samples.
  const double error = arrayOf(this->filter, Filter::GetLitFractionErrorName()).front();
  EXPECT_NEAR(error, std::sqrt(expected * (1.0 - expected) / 1023.0), 1e-4);
}

/// The visible part of the sun's disc past the edge of a half plane at height 10.
TEST_F(ClosedForms, TheSunsDiscHasAPenumbra)
{
  constexpr int cells = 16;
  const double width = 10.0 * std::tan(glm::radians(0.265)); // half of the penumbra's width
  const double far = 1e3;
  // Cells as flat as lines: all points of a cell see the same part of the disc.
  this->filter->SetInputData(floorOf({ -1.5 * width, -1e-4 }, { 1.5 * width, 1e-4 }, cells));
  this->filter->AddInputData(
    1, quad({ -far, -far, 10 }, { 0, -far, 10 }, { 0, far, 10 }, { -far, far, 10 }));
  this->filter->SetAngularDiameter(0.53);
  this->filter->SetSamples(4096);
  this->filter->AddDirection(0.0, 0.0, 1.0);
  for (const bool ofPoints : { false, true })
  {
    this->filter->SetElements(ofPoints ? Filter::POINTS : Filter::CELLS);
    const std::vector<double> fraction = arrayOf(this->filter, Filter::GetLitFractionName());
    for (int i = 0; i < cells; ++i)
    {
      const double at = 3.0 * (i + (ofPoints ? 0.0 : 0.5)) / cells - 1.5;
      // The mean over the cell's width, by Simpson's rule.
      const double half = ofPoints ? 0.0 : 1.5 / cells;
      const double expected =
        (diskShare(at - half) + 4.0 * diskShare(at) + diskShare(at + half)) / 6.0;
      EXPECT_NEAR(fraction[i], expected, 0.005) << at;
    }
  }
}

/// A ball's shadow has the area of an ellipse; half of the ball is turned away.
TEST_F(ClosedForms, ABallsShadowIsAnEllipse)
{
  constexpr int cells = 60;
  this->filter->SetInputData(floorOf({ -4.0, -4.0 }, { 4.0, 4.0 }, cells));
  const Mesh ball = makeSphere(96, 192);
  this->filter->AddInputData(1, polyData(ball, { 0.5, 0.0, 2.0 }));
  this->filter->SetSamples(64);
  const glm::dvec3 towards = glm::normalize(glm::dvec3(0.7, -0.4, 1.0));
  this->filter->AddDirection(&towards.x);
  const std::vector<double> fraction = arrayOf(this->filter, Filter::GetLitFractionName());
  const double lit = std::accumulate(fraction.begin(), fraction.end(), 0.0);
  const double shadow = (cells * cells - lit) * 64.0 / (cells * cells);
  const double expected = glm::pi<double>() / towards.z;
  EXPECT_NEAR(shadow, expected, 0.005 * expected);

  vtkNew<Filter> ofBall;
  ofBall->SetInputData(polyData(ball));
  ofBall->AddDirection(&towards.x);
  const std::vector<double> own = arrayOf(ofBall, Filter::GetLitFractionName());
  const std::vector<double> why = arrayOf(ofBall, Filter::GetWhyName());
  ASSERT_EQ(own.size(), ball.triangles.size());
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    const glm::uvec3& corners = ball.triangles[i];
    const glm::dvec3& a = ball.points[corners.x];
    const glm::dvec3 normal = glm::cross(ball.points[corners.y] - a, ball.points[corners.z] - a);
    const bool faces = glm::dot(normal, towards) > 0.0;
    EXPECT_EQ(own[i], faces ? 1.0 : 0.0) << i;
    EXPECT_EQ(why[i], faces ? Filter::LIT : Filter::TURNED_AWAY) << i;
  }
}

/// A lamp over a floor: the box's shadow by similar triangles.
TEST_F(ClosedForms, ALampsShadowGrowsWithTheDistance)
{
  constexpr int cells = 40;
  this->filter->SetInputData(floorOf({ -4.0, -4.0 }, { 4.0, 4.0 }, cells));
  this->filter->AddInputData(1, quad({ -1, -1, 1 }, { 1, -1, 1 }, { 1, 1, 1 }, { -1, 1, 1 }));
  this->filter->SetSamples(16);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetConeAngle(90.0);
  lamp->SetPosition(0.0, 0.0, 3.0);
  this->filter->AddLight(lamp);
  const std::vector<double> fraction = arrayOf(this->filter, Filter::GetLitFractionName());
  const double lit = std::accumulate(fraction.begin(), fraction.end(), 0.0);
  EXPECT_NEAR((cells * cells - lit) * 64.0 / (cells * cells), 9.0, 0.045);
}

/// A wall faces south. The sun is in front of it while it is south of the east-west line. At the
/// equator that is half of the day on an equinox, and all day or never on a solstice.
TEST_F(ClosedForms, AWallHasItsHoursOfSun)
{
  vtkNew<vtkGnomonSun> sun;
  sun->SetPlace(0.0, 0.0);
  this->filter->SetInputData(quad({ 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 })); // faces -y
  sun->SetDate(2026, 12, 21);
  this->filter->AddSunDay(sun, 1.0);
  EXPECT_NEAR(arrayOf(this->filter, Filter::GetHoursName()).front(), 12.0, 0.06);
  this->filter->ClearLights();
  sun->SetDate(2026, 6, 21);
  this->filter->AddSunDay(sun, 1.0);
  EXPECT_EQ(arrayOf(this->filter, Filter::GetHoursName()).front(), 0.0);
  // A flat roof gets all hours of sun.
  this->filter->SetInputData(quad({ 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }));
  EXPECT_NEAR(arrayOf(this->filter, Filter::GetHoursName()).front(), 12.0, 0.06);
  EXPECT_EQ(arrayOf(this->filter, Filter::GetLitFractionName()).front(), 1.0);
  this->filter->ClearLights();
  this->filter->AddSunYear(sun, 15, 30.0);
  EXPECT_NEAR(arrayOf(this->filter, Filter::GetHoursName()).front(), 365.0 * 12.0, 22.0);
}

/// The stated error is that of independent samples. Even samples have a smaller error.
TEST_F(ClosedForms, StatedErrorsAreKept)
{
  constexpr int cells = 32;
  const double far = 1e3;
  this->filter->SetInputData(floorOf({ 0.0, 0.0 }, { 1.0, 1.0 }, cells));
  // The edge of the shadow is x = y / 8 + 0.4.
  this->filter->AddInputData(1,
    quad({ -far, -far, 1 }, { 0.4 - far / 8.0, -far, 1 }, { 0.4 + far / 8.0, far, 1 },
      { -far, far, 1 }));
  this->filter->SetSamples(16);
  this->filter->AddDirection(0.0, 0.0, 1.0);
  const std::vector<double> fraction = arrayOf(this->filter, Filter::GetLitFractionName());
  const std::vector<double> error = arrayOf(this->filter, Filter::GetLitFractionErrorName());
  double squares = 0.0;
  double stated = 0.0;
  int cut = 0;
  double sum = 0.0;
  double sumExpected = 0.0;
  for (int cell = 0; cell < cells * cells; ++cell)
  {
    double expected = 0.0; // summed over many strips
    constexpr int strips = 256;
    for (int i = 0; i < strips; ++i)
    {
      const int row = cell / cells;
      const double y = (row + (i + 0.5) / strips) / cells;
      const double edge = (y / 8.0 + 0.4) * cells - cell % cells;
      expected += glm::clamp(1.0 - edge, 0.0, 1.0) / strips;
    }
    sum += fraction[cell];
    sumExpected += expected;
    if (expected > 0.1 && expected < 0.9)
    {
      ++cut;
      squares += (fraction[cell] - expected) * (fraction[cell] - expected);
      stated += error[cell] * error[cell];
      EXPECT_LT(std::abs(fraction[cell] - expected), 4.0 * error[cell]) << cell;
    }
    else if (expected == 0.0 || expected == 1.0)
    {
      EXPECT_EQ(fraction[cell], expected) << cell;
      EXPECT_EQ(error[cell], 0.0) << cell;
    }
  }
  ASSERT_GT(cut, 20);
  EXPECT_LT(squares, stated);
  EXPECT_LT(stated, cut * 0.14 * 0.14);
  EXPECT_NEAR(sum, sumExpected, 0.005 * sumExpected);
}

} // namespace
} // namespace gnomon::test
