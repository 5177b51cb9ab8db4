// Compare the filter's view of the sky with closed forms.

#include "DataMeshes.h"
#include "VtkMessages.h"

#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

using Filter = vtkGnomonVisibilityFilter;

constexpr double far = 1e4;

/// Return a vertical wall in the plane x = `x`, from the ground up to a height.
vtkSmartPointer<vtkPolyData> wallAt(double x, double height)
{
  return quad({ x, -far, 0 }, { x, far, 0 }, { x, far, height }, { x, -far, height });
}

/// A small receiver that looks along its normal.
vtkSmartPointer<vtkPolyData> patchAt(const glm::dvec3& at, const glm::dvec3& normal)
{
  const glm::dvec3 aside = glm::normalize(
    glm::cross(normal, std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 u = 1e-3 * aside;
  const glm::dvec3 v = glm::cross(normal, u);
  return quad(at - u - v, at + u - v, at + u + v, at - u + v);
}

struct SkyTest : testing::Test
{
  SkyTest() { this->filter->SetUp(0.0, 0.0, 1.0); }
  void TearDown() override { EXPECT_TRUE(this->messages.errors().empty()); }

  /// Return the view of the first element.
  double view()
  {
    const std::vector<double> views = arrayOf(this->filter, Filter::GetSkyViewName());
    return views.empty() ? NAN : views.front();
  }
  double error() { return arrayOf(this->filter, Filter::GetSkyViewErrorName()).front(); }

  vtkNew<Filter> filter;
  tool::VtkMessages messages;
};

/// Ground at distance d from an endless wall of height H sees, of a uniform sky above it,
/// (1 + cos(atan(H / d))) / 2; of a street's middle, the cosine (1 - sin(g)) of both walls is left.
TEST_F(SkyTest, WallsHideWhatTheirHeightSays)
{
  struct Row
  {
    double distance, height, otherHeight;
  };
  for (const Row& row : { Row{ 1, 1, 0 }, { 0.1, 1, 0 }, { 3, 1, 0 }, { 1, 1, 1 }, { 1, 0.5, 2 } })
  {
    for (const int model : { Filter::UNIFORM, Filter::DOME })
    {
      vtkNew<Filter> of;
      of->SetUp(0.0, 0.0, 1.0);
      of->SetInputData(patchAt({ 0, 0, 0 }, { 0, 0, 1 }));
      of->AddInputData(1, wallAt(row.distance, row.height));
      if (row.otherHeight > 0.0)
      {
        of->AddInputData(1, wallAt(-row.distance, row.otherHeight));
      }
      of->AddSky(model, 1024);
      const auto hidden = [&](double height)
      { return 0.5 * (1.0 - std::cos(std::atan2(height, row.distance))); };
      const double expected = 1.0 - hidden(row.height) - hidden(row.otherHeight);
      const double view = arrayOf(of, Filter::GetSkyViewName()).front();
      const double error = arrayOf(of, Filter::GetSkyViewErrorName()).front();
      EXPECT_NEAR(view, expected, 3.0 * error) << row.distance << " " << row.height;
      EXPECT_LT(error, 0.015);
      EXPECT_NEAR(view, expected, 0.005);
    }
  }
}

/// The bottom of a hemispherical pit sees what its rim leaves: all that is above the horizon. The
/// pole of a spherical pit whose opening is seen at `angle` from the vertical sees sin(angle)^2.
TEST_F(SkyTest, APitShowsItsOpening)
{
  constexpr double angle = 0.6;
  constexpr int around = 256;
  std::vector<vtkSmartPointer<vtkPolyData>> rim;
  const double radius = std::tan(angle);
  for (int i = 0; i < around; ++i) // an annulus at height 1
  {
    const auto at = [&](int number, double distance)
    {
      const double turn = 2.0 * glm::pi<double>() * number / around;
      return glm::dvec3(distance * std::cos(turn), distance * std::sin(turn), 1.0);
    };
    rim.push_back(quad(at(i, radius), at(i, far), at(i + 1, far), at(i + 1, radius)));
  }
  this->filter->SetInputData(patchAt({ 0, 0, 0 }, { 0, 0, 1 }));
  this->filter->AddInputData(1, together(rim));
  this->filter->AddSky(Filter::UNIFORM, 4096);
  EXPECT_NEAR(this->view(), std::sin(angle) * std::sin(angle), 0.003);
  this->filter->AddSky(Filter::OVERCAST, 4096);
  // 1/pi * integral of 3/7 (1 + 2 cos t) cos t sin t
  const double cosine = std::cos(angle);
  const double expected =
    3.0 / 7.0 * (1.0 - cosine * cosine) + 4.0 / 7.0 * (1.0 - cosine * cosine * cosine);
  EXPECT_NEAR(this->view(), expected, 0.003 + 3.0 * this->error());
}

/// A wall before open ground: half of the dome, and 0.396 of the overcast sky.
TEST_F(SkyTest, TheOpenSkyIsExact)
{
  struct Row
  {
    int model;
    double tilt, expected;
  };
  const double pi = glm::pi<double>();
  for (const Row& row :
    { Row{ Filter::UNIFORM, 0.0, 1.0 }, { Filter::UNIFORM, 2.0, 1.0 }, { Filter::DOME, 0.0, 1.0 },
      { Filter::DOME, 0.5 * pi, 0.5 }, { Filter::OVERCAST, 0.0, 1.0 },
      { Filter::OVERCAST, 0.5 * pi, 3.0 / 14.0 + 4.0 / (7.0 * pi) }, { Filter::OVERCAST, pi, 0.0 },
      { Filter::DOME, pi, 0.0 } })
  {
    vtkNew<Filter> of;
    of->SetUp(0.0, 0.0, 2.0);
    of->SetInputData(patchAt({ 0, 0, 0 }, { std::sin(row.tilt), 0.0, std::cos(row.tilt) }));
    of->AddSky(row.model, 64);
    EXPECT_NEAR(arrayOf(of, Filter::GetSkyViewName()).front(), row.expected, 1e-6) << row.tilt;
    EXPECT_EQ(arrayOf(of, Filter::GetSkyViewErrorName()).front(), 0.0);
  }
}

TEST_F(SkyTest, APlateSeesAllAndTheInsideOfABoxNothing)
{
  this->filter->SetInputData(floorOf({ -3.0, -2.0 }, { 5.0, 1.0 }, 20));
  this->filter->AddSky(Filter::UNIFORM, 256);
  for (const bool ofPoints : { false, true })
  {
    this->filter->SetElements(ofPoints ? Filter::POINTS : Filter::CELLS);
    EXPECT_THAT(arrayOf(this->filter, Filter::GetSkyViewName()), testing::Each(1.0));
  }
  this->filter->SetInputData(polyData(apart(makeBox({ 0, 0, 0 }, { 1, 1, 1 }))));
  for (const int side : { Filter::FRONT, Filter::BACK, Filter::BOTH })
  {
    this->filter->SetReceivingSide(side);
    for (const bool ofPoints : { false, true })
    {
      this->filter->SetElements(ofPoints ? Filter::POINTS : Filter::CELLS);
      EXPECT_THAT(arrayOf(this->filter, Filter::GetSkyViewName()),
        testing::Each(side == Filter::BACK ? 0.0 : 1.0));
    }
  }
}

/// Beyond the distance nothing occludes, in any unit of length.
TEST_F(SkyTest, NothingBeyondTheDistanceHides)
{
  for (const double unit : { 1e-6, 1.0, 1e9 })
  {
    vtkNew<Filter> of;
    of->SetInputData(quad({ 0, 0, 0 }, { unit, 0, 0 }, { unit, unit, 0 }, { 0, unit, 0 }));
    const double big = 1e3 * unit;
    of->AddInputData(1,
      quad({ -big, -big, 2 * unit }, { big, -big, 2 * unit }, { big, big, 2 * unit },
        { -big, big, 2 * unit }));
    of->AddSky(Filter::UNIFORM, 256);
    const auto view = [&] { return arrayOf(of, Filter::GetSkyViewName()).front(); };
    EXPECT_LT(view(), 0.001);
    of->SetSkyDistance(1.9 * unit);
    EXPECT_EQ(view(), 1.0);
    of->SetSkyDistance(4.0 * unit); // rays of more than 60 degrees off the normal pass
    EXPECT_NEAR(view(), 0.25, 0.01);
  }
}

TEST_F(SkyTest, TheErrorIsThatOfTheDirections)
{
  constexpr int cells = 16;
  this->filter->SetInputData(floorOf({ -2.0, -2.0 }, { 0.9, 2.0 }, cells));
  this->filter->AddInputData(1, wallAt(1.0, 1.0));
  for (const int directions : { 64, 256, 1024 })
  {
    this->filter->AddSky(Filter::UNIFORM, directions);
    const std::vector<double> views = arrayOf(this->filter, Filter::GetSkyViewName());
    const std::vector<double> errors = arrayOf(this->filter, Filter::GetSkyViewErrorName());
    double squares = 0.0;
    double stated = 0.0;
    for (int cell = 0; cell < cells * cells; ++cell)
    {
      const double distance = 1.0 - (-2.0 + 2.9 * (cell % cells + 0.5) / cells);
      const double off = views[cell] - 0.5 * (1.0 + std::cos(std::atan2(1.0, distance)));
      squares += off * off;
      stated += errors[cell] * errors[cell];
    }
    EXPECT_LT(std::sqrt(squares), std::sqrt(stated)) << directions;
    EXPECT_GT(std::sqrt(squares), 0.2 * std::sqrt(stated)) << directions;
    EXPECT_LT(std::sqrt(squares / (cells * cells)), directions == 64 ? 0.02 : 0.008);
  }
}

/// A sky beside a light changes no bit of the light's results, an abort none of either's.
TEST_F(SkyTest, SharesAnExecutionWithLights)
{
  this->filter->SetInputData(floorOf({ -2.0, -2.0 }, { 0.9, 2.0 }, 40));
  this->filter->AddInputData(1, wallAt(1.0, 1.0));
  this->filter->AddSky(Filter::OVERCAST, 1024);
  const std::vector<double> views = arrayOf(this->filter, Filter::GetSkyViewName());
  EXPECT_EQ(this->filter->GetNumberOfRays(), 1600 * 1024);
  EXPECT_TRUE(shownArrayOf(this->filter, Filter::GetHoursName()).empty());
  this->filter->AddDirection(1.0, 0.2, 1.0, 3.0);
  const std::vector<double> hours = arrayOf(this->filter, Filter::GetHoursName());
  EXPECT_EQ(shownArrayOf(this->filter, Filter::GetSkyViewName()), views);
  this->filter->ClearLights();
  this->filter->AddDirection(1.0, 0.2, 1.0, 3.0);
  EXPECT_EQ(arrayOf(this->filter, Filter::GetHoursName()), hours);
  EXPECT_TRUE(shownArrayOf(this->filter, Filter::GetSkyViewName()).empty());

  this->filter->AddSky(Filter::OVERCAST, 1024);
  int parts = 0;
  double last = 0.0;
  const Progress progress(this->filter,
    [&](double share)
    {
      EXPECT_TRUE(share >= last || share == 0.0) << share; // VTK itself tells of 0
      last = std::max(last, share);
      ++parts;
      this->filter->AbortExecuteOn();
    });
  int executions = 0;
  do
  {
    this->filter->Update();
    ++executions;
  } while (shownArrayOf(this->filter, Filter::GetSkyViewName()).empty() && executions < 10);
  EXPECT_GT(executions, 1);
  EXPECT_GT(parts, 1);
  EXPECT_EQ(shownArrayOf(this->filter, Filter::GetSkyViewName()), views);
  EXPECT_EQ(shownArrayOf(this->filter, Filter::GetHoursName()), hours);
}

TEST_F(SkyTest, EachMistakeIsOneError)
{
  this->filter->SetInputData(floorOf({ 0.0, 0.0 }, { 1.0, 1.0 }, 2));
  const std::vector<std::function<void()>> wrong = {
    [this] { this->filter->AddSky(3, 64); },
    [this] { this->filter->AddSky(-1, 64); },
    [this] { this->filter->AddSky(Filter::DOME, 100); },
    [this] { this->filter->AddSky(Filter::DOME, 8); },
    [this] { this->filter->AddSky(Filter::DOME, 131072); },
    [this] { this->filter->SetSkyDistance(-1.0); },
    [this] { this->filter->SetSkyDistance(NAN); },
    [this] { this->filter->Update(); }, // nothing was added
    [this]
    {
      this->filter->SetUp(0.0, 0.0, 0.0);
      this->filter->AddSky(Filter::OVERCAST, 64);
      this->filter->Update();
    },
  };
  const tool::VtkMessages own;
  for (std::size_t i = 0; i < wrong.size(); ++i)
  {
    wrong[i]();
    EXPECT_EQ(own.errors().size(), i + 1) << i;
  }
  EXPECT_TRUE(shownArrayOf(this->filter, Filter::GetSkyViewName()).empty());
}

/// A wall from the ground hides a patch if the ray to its middle meets it.
TEST_F(SkyTest, PatchesAreTheMatrixOfElementsAndSky)
{
  const double up[3] = { 0.0, 0.0, 2.0 };
  const double north[3] = { 0.0, 3.0, 1.0 };
  this->filter->AddSkyPatches(up, north);
  this->filter->ComputeBitsOn();
  this->filter->SetInputData(0, patchAt({ 0, 0, 0 }, { 0, 0, 1 }));
  ASSERT_EQ(this->filter->GetNumberOfLights(), 145);
  this->filter->Update();
  const auto seen = [&] { return arrayOf(this->filter, Filter::GetHoursName()).front(); };
  EXPECT_NEAR(seen(), 2.0 * glm::pi<double>(), 1e-6);

  this->filter->AddInputData(1, wallAt(1.0, 2.0));
  this->filter->Update();
  const std::vector<double> bits = arrayOf(this->filter, Filter::GetBitsName());
  ASSERT_EQ(bits.size(), 19u);
  double free = 0.0;
  for (int i = 0; i < 145; ++i)
  {
    double towards[3];
    this->filter->GetDirection(i, towards);
    const bool isFree = towards[0] <= 0.0 || towards[2] > 2.0 * towards[0];
    EXPECT_EQ(static_cast<int>(bits[i / 8]) >> i % 8 & 1, isFree ? 1 : 0) << i;
    free += isFree ? this->filter->GetHours(i) : 0.0;
  }
  EXPECT_NEAR(seen(), free, 1e-6);
  double first[3];
  this->filter->GetDirection(0, first); // in the north, 6 degrees up
  EXPECT_NEAR(first[1], std::cos(glm::radians(6.0)), 1e-12);
  this->filter->GetDirection(1, first);
  EXPECT_GT(first[0], 0.0); // on to the east

  const tool::VtkMessages refused;
  this->filter->AddSkyPatches(up, up);
  EXPECT_EQ(this->filter->GetNumberOfLights(), 145);
  ASSERT_EQ(refused.errors().size(), 1u);
  EXPECT_NE(refused.errors().front().find("two directions"), std::string::npos);
}

} // namespace
} // namespace gnomon::test
