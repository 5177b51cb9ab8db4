#include "lights/vtkGnomonSun.h"

#include "VtkMessages.h"

#include "lights/SunPosition.h"

#include <glm/glm.hpp>
#include <gmock/gmock.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>

#include <cmath>
#include <limits>

namespace gnomon::test
{
namespace
{

using testing::HasSubstr;

class Sun : public testing::Test
{
protected:
  void TearDown() override { EXPECT_EQ(this->messages.errors().size(), this->errorsTaken); }
  glm::dvec3 direction()
  {
    glm::dvec3 towards;
    this->sun->GetDirection(&towards.x);
    return towards;
  }
  template <typename Call>
  void expectError(const Call& call, const char* text)
  {
    call();
    ASSERT_EQ(this->messages.errors().size(), ++this->errorsTaken) << text;
    EXPECT_THAT(this->messages.errors().back(), HasSubstr(text));
  }

  vtkNew<vtkGnomonSun> sun;
  tool::VtkMessages messages;
  std::size_t errorsTaken = 0;
};

/// Reda and Andreas 2004, appendix A.5.
TEST_F(Sun, StandsWhereTheAlgorithmsOwnExampleSays)
{
  this->sun->SetDate(2003, 10, 17);
  this->sun->SetTime(12, 30, 30.0, -7.0);
  this->sun->SetPlace(39.742476, -105.1786);
  this->sun->SetAltitude(1830.14);
  this->sun->SetDeltaT(67.0);
  this->sun->SetAir(820.0, 11.0);
  this->sun->RefractionOn();
  EXPECT_NEAR(this->sun->GetElevation(), 90.0 - 50.11162, 0.001);
  EXPECT_NEAR(this->sun->GetAzimuth(), 194.34024, 0.001);
  this->sun->RefractionOff();
  EXPECT_NEAR(this->sun->GetElevation(), 39.872046, 0.001);
}

/// Computed by PyEphem 4.1.4, which has all of VSOP87: dates and times in UTC, Delta T, then
/// azimuth and elevation without refraction.
TEST_F(Sun, AgreesWithAnotherEphemeris)
{
  struct Row
  {
    int year, month, day, hour, minute;
    double latitude, longitude, deltaT, azimuth, elevation;
  };
  const Row rows[] = {
    { 2024, 9, 28, 14, 28, 48.139, -111.635, 72.8, 104.9725, 9.9388 },
    { 2026, 8, 21, 19, 50, -45.731, -70.776, 74.3, 311.9005, 19.0985 },
    { 1923, 9, 26, 22, 40, -88.828, -37.382, 23.4, 235.2345, 0.4436 },
    { 2024, 11, 24, 19, 41, -44.778, 119.413, 72.9, 127.1878, -5.8944 },
    { 1923, 1, 2, 6, 56, -22.821, 100.119, 23.0, 264.9552, 68.6603 },
    { 2000, 8, 19, 6, 33, -22.747, -0.082, 64.0, 75.5261, 1.6758 },
    { 2099, 2, 15, 20, 17, 12.896, 178.449, 223.3, 110.2756, 24.6477 },
    { 1923, 12, 9, 10, 48, -22.977, -169.289, 23.5, 186.8012, -43.9890 },
    { 2050, 2, 13, 3, 54, -5.204, 164.895, 108.3, 255.4845, 49.8787 },
    { 2099, 1, 7, 6, 59, -89.054, 172.929, 223.0, 263.4708, 22.2078 },
    { 2010, 7, 3, 18, 40, -22.499, -82.881, 66.2, 339.9684, 41.9670 },
    { 1923, 5, 11, 0, 26, -66.658, 74.526, 23.2, 90.1864, -19.2642 },
    { 1900, 1, 15, 15, 11, 64.107, -18.927, -2.7, 204.5431, 2.3174 },
    { 1975, 12, 25, 4, 26, 63.791, -37.853, 46.4, 38.9033, -45.3916 },
    { 1975, 1, 9, 18, 19, -89.521, -38.061, 45.5, 304.9154, 22.3858 },
    { 2050, 11, 19, 3, 2, -45.516, -87.02, 109.8, 217.1044, -16.4909 },
  };
  const double defaultDeltaT = this->sun->GetDeltaT();
  for (const Row& row : rows)
  {
    this->sun->SetDate(row.year, row.month, row.day);
    this->sun->SetTime(row.hour, row.minute, 0.0, 0.0);
    this->sun->SetPlace(row.latitude, row.longitude);
    this->sun->SetDeltaT(row.deltaT);
    const double azimuth = glm::radians(row.azimuth);
    const double elevation = glm::radians(row.elevation);
    const glm::dvec3 expected(std::cos(elevation) * std::sin(azimuth),
      std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
    EXPECT_LT(glm::degrees(glm::distance(this->direction(), expected)), 0.001)
      << row.year << "-" << row.month << "-" << row.day;
    this->sun->SetDeltaT(defaultDeltaT);
    EXPECT_LT(glm::degrees(glm::distance(this->direction(), expected)), 0.003)
      << row.year << "-" << row.month << "-" << row.day;
  }
}

/// Refraction by the report's equation 42. At the horizon it is 28.98 minutes of arc (Saemundsson
/// 1986, in Meeus, chapter 16), for 1010 millibar and 10 degrees Celsius.
TEST_F(Sun, IsLiftedByTheAir)
{
  EXPECT_NEAR(refractionDegrees(0.0, 1010.0, 10.0), 28.98 / 60.0, 0.0005);
  EXPECT_NEAR(refractionDegrees(0.0, 505.0, 293.0), 28.98 / 240.0, 0.0005);
  EXPECT_NEAR(refractionDegrees(45.0, 1010.0, 10.0), 1.01 / 60.0, 0.0005);
  EXPECT_EQ(refractionDegrees(-0.85, 1010.0, 10.0), 0.0);
  this->sun->SetPlace(0.0, 0.0);
  this->sun->SetTime(6, 8, 0.0, 0.0); // just after sunrise
  const double low = this->sun->GetElevation();
  ASSERT_LT(std::abs(low), 0.5);
  this->sun->RefractionOn();
  EXPECT_NEAR(this->sun->GetElevation() - low, refractionDegrees(low, 1010.0, 10.0), 1e-12);
}

TEST_F(Sun, YearsLeapByTheGregorianCalendar)
{
  this->sun->SetDate(2024, 2, 29);
  this->sun->SetDate(2000, 2, 29);
  this->expectError([&] { this->sun->SetDate(2100, 2, 29); }, "no date 2100-2-29");
  this->expectError([&] { this->sun->SetDate(2023, 2, 29); }, "no date 2023-2-29");
  EXPECT_EQ(this->sun->GetYear(), 2000);
  EXPECT_EQ(julianDayOf(2000, 1, 1), 2451544.5);
  EXPECT_EQ(julianDayOf(1600, 12, 31), 2305812.5); // Meeus, chapter 7
  EXPECT_EQ(julianDayOf(1987, 6, 19), 2446965.5);
}

TEST_F(Sun, ZonesAndClocksNameTheSameMoment)
{
  this->sun->SetPlace(47.0, 11.0);
  this->sun->SetDate(2026, 3, 1);
  this->sun->SetTime(1, 30, 30.0, 13.0);
  const glm::dvec3 first = this->direction();
  this->sun->SetDate(2026, 2, 28);
  this->sun->SetTime(12, 30, 30.0, 0.0);
  EXPECT_LT(glm::distance(this->direction(), first), 1e-8);
  this->sun->SetTime(2, 0, 30.0, -10.5);
  EXPECT_LT(glm::distance(this->direction(), first), 1e-8);
}

TEST_F(Sun, ScenesHaveAxesOfTheirOwn)
{
  this->sun->SetPlace(52.0, 13.0);
  this->sun->SetDate(2026, 6, 21);
  this->sun->SetTime(8, 0, 0.0, 0.0);
  const glm::dvec3 usual = this->direction();
  EXPECT_GT(usual.x, 0.5); // in the morning the sun is in the east
  EXPECT_NEAR(glm::length(usual), 1.0, 1e-12);
  EXPECT_NEAR(glm::degrees(std::asin(usual.z)), this->sun->GetElevation(), 1e-9);
  const double north[3] = { 0.0, 2.0, -3.0 }; // the part along Up does not count
  const double up[3] = { 0.0, 5.0, 0.0 };
  this->sun->SetNorthAndUp(north, up);
  EXPECT_LT(glm::distance(this->direction(), { usual.x, usual.z, -usual.y }), 1e-12);
}

TEST_F(Sun, DaysHaveTheirHours)
{
  vtkNew<vtkDoubleArray> directions;
  vtkNew<vtkDoubleArray> hours;
  vtkNew<vtkDoubleArray> times;
  const auto total = [&]
  {
    double sum = 0.0;
    for (vtkIdType i = 0; i < hours->GetNumberOfTuples(); ++i)
    {
      sum += hours->GetValue(i);
    }
    return sum;
  };
  // 12 hours at an equinox; sunrise and sunset are those of the disc's centre.
  this->sun->SetPlace(40.0, 0.0);
  this->sun->MakeDayPath(1.0, directions, hours, times);
  EXPECT_NEAR(total(), 12.0, 0.05);
  ASSERT_EQ(directions->GetNumberOfTuples(), hours->GetNumberOfTuples());
  ASSERT_EQ(times->GetNumberOfTuples(), hours->GetNumberOfTuples());
  for (vtkIdType i = 0; i < directions->GetNumberOfTuples(); ++i)
  {
    EXPECT_GT(directions->GetComponent(i, 2), 0.0);
  }
  EXPECT_NEAR(times->GetValue(0), 6.1, 0.1); // 12 hours around noon, which is at 12:07

  // Without refraction and disc, half of a leap year is day in all places.
  this->sun->SetPlace(30.0, 50.0);
  this->sun->MakeYearPath(1, 20.0, directions, hours, times);
  EXPECT_NEAR(total(), 366.0 * 12.0, 15.0);
  this->sun->MakeYearPath(7, 20.0, directions, hours);
  EXPECT_NEAR(total(), 366.0 * 12.0, 15.0);
  // In the polar night there is no sun.
  this->sun->SetPlace(85.0, 0.0);
  this->sun->SetDate(2000, 12, 21);
  this->sun->MakeDayPath(10.0, directions, hours);
  EXPECT_EQ(directions->GetNumberOfTuples(), 0);
  EXPECT_EQ(directions->GetNumberOfComponents(), 3);
}

TEST_F(Sun, AStepThatDoesNotDivideTheDayEndsWithIt)
{
  this->sun->SetPlace(89.0, 0.0);
  this->sun->SetDate(2000, 6, 21);
  vtkNew<vtkDoubleArray> directions;
  vtkNew<vtkDoubleArray> hours;
  this->sun->MakeDayPath(7.0 * 60.0, directions, hours);
  ASSERT_EQ(hours->GetNumberOfTuples(), 4);
  EXPECT_DOUBLE_EQ(hours->GetValue(2), 7.0);
  EXPECT_DOUBLE_EQ(hours->GetValue(3), 3.0);
}

TEST_F(Sun, InvalidValuesAreErrorsAndChangeNothing)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const vtkMTimeType time = this->sun->GetMTime();
  this->expectError([&] { this->sun->SetDate(2026, 2, 29); }, "no date 2026-2-29");
  this->expectError([&] { this->sun->SetDate(2026, 13, 1); }, "no date 2026-13-1");
  this->expectError([&] { this->sun->SetTime(12, 0, nan, 0.0); }, "no time 12:0:nan");
  this->expectError([&] { this->sun->SetTime(12, 0, 0.0, 15.0); }, "15 hours east");
  this->expectError([&] { this->sun->SetPlace(90.5, 0.0); }, "latitude 90.5");
  this->expectError([&] { this->sun->SetAltitude(nan); }, "Altitude was to be nan");
  this->expectError([&] { this->sun->SetDeltaT(nan); }, "DeltaT was to be nan");
  this->expectError([&] { this->sun->SetAir(-1.0, 10.0); }, "no air");
  const double up[3] = { 0.0, 0.0, 1.0 };
  const double along[3] = { 0.0, 0.0, -2.0 };
  this->expectError([&] { this->sun->SetNorthAndUp(along, up); }, "not be parallel");
  const double broken[3] = { nan, 0.0, 0.0 };
  this->expectError([&] { this->sun->SetNorthAndUp(broken, up); }, "not be parallel");
  vtkNew<vtkDoubleArray> directions;
  this->expectError(
    [&] { this->sun->MakeDayPath(0.0, directions, nullptr); }, "stepMinutes was to be 0");
  this->expectError([&] { this->sun->MakeDayPath(5.0, nullptr, nullptr); }, "needs an array");
  this->expectError(
    [&] { this->sun->MakeYearPath(0, 5.0, directions, nullptr); }, "dayStep was to be 0");
  EXPECT_EQ(this->sun->GetMTime(), time);
}

} // namespace
} // namespace gnomon::test
