#include "lights/vtkGnomonSun.h"

#include "VtkMessages.h"

#include "lights/LightManager.h"
#include "lights/SunPosition.h"
#include "lights/vtkGnomonLightKeys.h"
#include "lights/vtkGnomonLightPlacement.h"

#include <glm/glm.hpp>
#include <gmock/gmock.h>
#include <vtkCamera.h>
#include <vtkDoubleArray.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkLightKit.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkRenderer.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

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
  this->expectError([&] { this->sun->SetPlace(91.0, 0.0); }, "latitude 91");
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

using testing::HasSubstr;

class LightPlacement : public testing::Test
{
protected:
  glm::dvec3 position() { return vector(this->light->GetPosition()); }
  glm::dvec3 focalPoint() { return vector(this->light->GetFocalPoint()); }
  glm::dvec3 travel() { return glm::normalize(this->focalPoint() - this->position()); }
  static glm::dvec3 vector(const double numbers[3])
  {
    return { numbers[0], numbers[1], numbers[2] };
  }
  static void expectNear(const glm::dvec3& a, const glm::dvec3& b)
  {
    EXPECT_LT(glm::length(a - b), 1e-12) << a.x << ", " << a.y << ", " << a.z;
  }

  vtkNew<vtkLight> light;
  tool::VtkMessages messages;
  const double centre[3] = { 1.0, 2.0, 3.0 };
};

TEST_F(LightPlacement, DirectionalLightsBeginAtTheSphere)
{
  this->light->SetPosition(3.0, 4.0, 0.0);
  this->light->SetFocalPoint(0.0, 0.0, 0.0);
  vtkGnomonLightPlacement::ShineOnSphere(this->light, this->centre, 10.0);
  expectNear(this->focalPoint(), { 1.0, 2.0, 3.0 });
  expectNear(this->position(), { 7.0, 10.0, 3.0 });
}

TEST_F(LightPlacement, ConesOfSpotLightsJustHoldTheSphere)
{
  this->light->PositionalOn();
  this->light->SetConeAngle(30.0);
  vtkGnomonLightPlacement::ShineOnSphere(this->light, this->centre, 2.0);
  expectNear(this->travel(), { 0.0, 0.0, -1.0 });
  expectNear(this->position(), { 1.0, 2.0, 7.0 });

  this->light->SetConeAngle(180.0); // a point light
  vtkGnomonLightPlacement::ShineOnSphere(this->light, this->centre, 2.0);
  expectNear(this->position(), { 1.0, 2.0, 5.0 });
}

TEST_F(LightPlacement, BoxesAndPointsHaveTheirSpheres)
{
  const double bounds[6] = { -2.0, 4.0, 1.0, 3.0, 0.0, 6.0 };
  vtkGnomonLightPlacement::ShineOnBox(this->light, bounds);
  expectNear(this->focalPoint(), { 1.0, 2.0, 3.0 });
  EXPECT_NEAR(glm::length(this->position() - this->focalPoint()), std::sqrt(19.0), 1e-12);

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const glm::dvec3& point :
    { glm::dvec3(4, 2, 3), { -2, 2, 3 }, { 1, 3, 3 }, { 1, 1, 3 }, { 1, 2, 6 }, { 1, 2, 0 } })
  {
    points->InsertNextPoint(point.x, point.y, point.z);
  }
  vtkGnomonLightPlacement::ShineOnPoints(this->light, points);
  expectNear(this->focalPoint(), { 1.0, 2.0, 3.0 });
  EXPECT_NEAR(glm::length(this->position() - this->focalPoint()), 3.0, 1e-12);
}

TEST_F(LightPlacement, AKeyLightComesOverTheCamerasLeftShoulder)
{
  vtkNew<vtkCamera> camera; // looks along +x with z up, so y is to its left
  camera->SetPosition(-5.0, 0.0, 0.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  this->light->SetLightTypeToHeadlight();
  this->light->PositionalOn();
  this->light->SetTransformMatrix(vtkNew<vtkMatrix4x4>());
  const double bounds[6] = { 0.0, 2.0, 1.0, 3.0, 2.0, 4.0 };
  vtkGnomonLightPlacement::MakeKeyLight(this->light, camera, bounds);
  expectNear(this->focalPoint(), { 1.0, 2.0, 3.0 });
  const double cosine = std::cos(glm::radians(40.0));
  expectNear(this->travel(),
    { cosine * std::cos(glm::radians(35.0)), -cosine * std::sin(glm::radians(35.0)),
      -std::sin(glm::radians(40.0)) });
  EXPECT_NEAR(glm::distance(this->position(), this->focalPoint()), std::sqrt(3.0), 1e-12);
  EXPECT_TRUE(this->light->LightTypeIsSceneLight());
  EXPECT_FALSE(this->light->GetPositional());
  EXPECT_EQ(this->light->GetTransformMatrix(), nullptr);
}

TEST_F(LightPlacement, PitchAndYawAreThoseOfAHead)
{
  this->light->SetPosition(0.0, 0.0, 5.0);
  this->light->SetFocalPoint(1.0, 0.0, 5.0);
  const auto turned = [&](double pitch, double yaw)
  {
    vtkGnomonLightPlacement::SetPitchAndYaw(this->light, pitch, yaw);
    return this->travel();
  };
  expectNear(turned(0.0, 0.0), { 0.0, 0.0, -1.0 });
  expectNear(turned(0.0, 90.0), { -1.0, 0.0, 0.0 });
  expectNear(turned(-90.0, 0.0), { 0.0, -1.0, 0.0 });
  const double half = std::sqrt(0.5);
  expectNear(turned(-45.0, 180.0), { 0.0, -half, half });
  expectNear(this->focalPoint(), { 1.0, 0.0, 5.0 });
  EXPECT_NEAR(glm::length(this->position() - this->focalPoint()), 1.0, 1e-12);

  vtkNew<vtkLight> byVtk;
  byVtk->SetDirectionAngle(25.0, 70.0);
  expectNear(turned(-25.0, 70.0),
    glm::normalize(vector(byVtk->GetFocalPoint()) - vector(byVtk->GetPosition())));
}

TEST_F(LightPlacement, PositionalLightsTurnAboutTheirPosition)
{
  this->light->PositionalOn();
  this->light->SetPosition(0.0, 1.0, 5.0);
  this->light->SetFocalPoint(0.0, 1.0, 2.0);
  vtkGnomonLightPlacement::SetPitchAndYaw(this->light, -90.0, 0.0);
  expectNear(this->position(), { 0.0, 1.0, 5.0 });
  expectNear(this->focalPoint(), { 0.0, -2.0, 5.0 });
}

TEST_F(LightPlacement, InvalidTargetsAreErrorsAndChangeNothing)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::size_t errors = 0;
  const auto expectError = [&](const auto& call, const char* text)
  {
    call();
    ASSERT_EQ(this->messages.errors().size(), ++errors) << text;
    EXPECT_THAT(this->messages.errors().back(), HasSubstr(text));
    expectNear(this->position(), { 0.0, 0.0, 1.0 });
    expectNear(this->focalPoint(), { 0.0, 0.0, 0.0 });
  };
  expectError(
    [&] { vtkGnomonLightPlacement::ShineOnSphere(this->light, this->centre, 0.0); }, "radius 0");
  const double broken[3] = { 0.0, nan, 0.0 };
  expectError(
    [&] { vtkGnomonLightPlacement::ShineOnSphere(this->light, broken, 1.0); }, "center and radius");
  const double empty[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 }; // VTK's uninitialised bounds
  expectError([&] { vtkGnomonLightPlacement::ShineOnBox(this->light, empty); },
    "bounds give a sphere of radius 0");
  vtkNew<vtkCamera> camera;
  expectError(
    [&] { vtkGnomonLightPlacement::MakeKeyLight(this->light, camera, empty); }, "radius 0");
  camera->SetPosition(nan, 0.0, 0.0);
  const double unit[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  expectError(
    [&] { vtkGnomonLightPlacement::MakeKeyLight(this->light, camera, unit); }, "looks nowhere");
  vtkNew<vtkPoints> points;
  expectError([&] { vtkGnomonLightPlacement::ShineOnPoints(this->light, points); },
    "points give a sphere of radius 0");
  points->InsertNextPoint(0.0, nan, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  expectError(
    [&] { vtkGnomonLightPlacement::ShineOnPoints(this->light, points); }, "point 0 is not finite");
  expectError(
    [&] { vtkGnomonLightPlacement::SetPitchAndYaw(this->light, nan, 0.0); }, "pitchDegrees nan");

  this->light->SetPosition(0.0, 0.0, 0.0);
  vtkGnomonLightPlacement::ShineOnSphere(this->light, this->centre, 1.0);
  ASSERT_EQ(this->messages.errors().size(), errors + 1);
  EXPECT_THAT(this->messages.errors().back(), HasSubstr("no direction"));
  expectNear(this->focalPoint(), { 0.0, 0.0, 0.0 });
}

// Which lights cast: (lights of the scene, of the camera, at the camera, headlights, VTK's light
// kit) by each choice.

enum class Kind
{
  Scene,
  Camera,
  AtCamera,
  LampAtCamera,
  Head
};

vtkNew<vtkLight> makeLight(Kind kind, double intensity = 1.0)
{
  vtkNew<vtkLight> light;
  light->SetIntensity(intensity);
  switch (kind)
  {
    case Kind::Scene:
      light->SetLightTypeToSceneLight();
      break;
    case Kind::Head:
      light->SetLightTypeToHeadlight();
      break;
    default:
      light->SetLightTypeToCameraLight();
      light->SetPositional(kind == Kind::LampAtCamera);
      light->SetPosition(kind == Kind::Camera ? 0.5 : 0.0, 0.0, 1.0);
      light->SetFocalPoint(0.0, 0.0, 0.0);
  }
  return light;
}

struct Case
{
  const char* name;
  std::vector<std::pair<Kind, double>> lights; ///< with their intensities
  /// The indices of lights that cast, by `auto`, `all` and `brightest`.
  std::vector<int> byAuto, byAll, byBrightest;
};

const Case cases[] = {
  { "scene", { { Kind::Scene, 1.0 } }, { 0 }, { 0 }, { 0 } },
  { "camera", { { Kind::Camera, 1.0 } }, { 0 }, { 0 }, { 0 } },
  { "atCamera", { { Kind::AtCamera, 1.0 } }, {}, {}, {} },
  { "lampAtCamera", { { Kind::LampAtCamera, 1.0 } }, {}, {}, {} },
  { "head", { { Kind::Head, 1.0 } }, {}, {}, {} },
  { "sceneAndHead", { { Kind::Scene, 0.5 }, { Kind::Head, 1.0 } }, { 0 }, { 0 }, { 0 } },
  { "sceneAndCamera", { { Kind::Scene, 0.5 }, { Kind::Camera, 1.0 } }, { 0, 1 }, { 0, 1 }, { 1 } },
  { "sceneAndAtCamera", { { Kind::AtCamera, 1.0 }, { Kind::Scene, 0.5 } }, { 1 }, { 1 }, { 1 } },
  { "scenes", { { Kind::Scene, 0.5 }, { Kind::Scene, 1.0 } }, { 0, 1 }, { 0, 1 }, { 1 } },
  { "cameras", { { Kind::Camera, 0.5 }, { Kind::Camera, 1.0 }, { Kind::Camera, 1.0 } }, { 1 },
    { 0, 1, 2 }, { 1 } },
  { "all",
    { { Kind::Head, 2.0 }, { Kind::Camera, 0.5 }, { Kind::Scene, 1.0 }, { Kind::Camera, 0.7 } },
    { 2, 3 }, { 1, 2, 3 }, { 2 } },
};

std::vector<int> castingOf(vtkRenderer* renderer, Casting casting)
{
  std::vector<int> indices;
  const LightSet set = LightManager().collect(renderer, {}, casting);
  for (const ShadowLight& light : set.lights)
  {
    indices.push_back(light.sceneIndex);
  }
  EXPECT_EQ(set.lights.size() + set.skipped.size(),
    static_cast<std::size_t>(renderer->GetLights()->GetNumberOfItems()));
  for (const SkippedLight& skipped : set.skipped)
  {
    EXPECT_NE(skipped.reason, "");
  }
  return indices;
}

std::string reasonOf(vtkRenderer* renderer, int index)
{
  for (const SkippedLight& skipped : LightManager().collect(renderer, {}).skipped)
  {
    if (skipped.sceneIndex == index)
    {
      return skipped.reason;
    }
  }
  return "";
}

TEST(Casting, choosesLightsByTheirKind)
{
  for (const Case& of : cases)
  {
    SCOPED_TRACE(of.name);
    vtkNew<vtkRenderer> renderer;
    for (const auto& [kind, intensity] : of.lights)
    {
      renderer->AddLight(makeLight(kind, intensity));
    }
    EXPECT_EQ(castingOf(renderer, Casting::Auto), of.byAuto);
    EXPECT_EQ(castingOf(renderer, Casting::All), of.byAll);
    EXPECT_EQ(castingOf(renderer, Casting::Brightest), of.byBrightest);
    EXPECT_EQ(LightManager().collect(renderer, {}).headlightIsAlone, of.byAll.empty());
  }
}

TEST(Casting, takesALightKitsKeyLight)
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkLightKit> kit; // key, fill, head and two back lights
  kit->AddLightsToRenderer(renderer);
  ASSERT_EQ(renderer->GetLights()->GetNumberOfItems(), 5);
  const std::vector<int> casting = castingOf(renderer, Casting::Auto);
  ASSERT_EQ(casting.size(), 1u);
  auto* const light =
    vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(casting.front()));
  EXPECT_EQ(light->GetIntensity(), kit->GetKeyLightIntensity());
  EXPECT_EQ(castingOf(renderer, Casting::All).size(), 4u);
  EXPECT_EQ(castingOf(renderer, Casting::Brightest), casting);
}

TEST(Casting, followsALightsKey)
{
  for (const Kind kind :
    { Kind::Scene, Kind::Camera, Kind::AtCamera, Kind::LampAtCamera, Kind::Head })
  {
    for (const Casting casting : { Casting::Auto, Casting::All, Casting::Brightest })
    {
      vtkNew<vtkRenderer> renderer;
      const auto light = makeLight(kind, 0.5);
      const auto brighter = makeLight(Kind::Camera, 1.0);
      renderer->AddLight(light);
      renderer->AddLight(brighter);
      vtkGnomonLightKeys::SetCasts(light, true);
      EXPECT_THAT(castingOf(renderer, casting), testing::ElementsAre(0, 1));
      vtkGnomonLightKeys::SetCasts(light, false);
      vtkGnomonLightKeys::SetCasts(brighter, false);
      EXPECT_THAT(castingOf(renderer, casting), testing::ElementsAre());
    }
  }
}

TEST(Casting, givesReasonsForSkippedLights)
{
  vtkNew<vtkRenderer> renderer;
  const auto head = makeLight(Kind::Head);
  renderer->AddLight(head);
  EXPECT_EQ(reasonOf(renderer, 0), "a headlight, and the only light");
  const auto fill = makeLight(Kind::Camera, 0.2);
  const auto key = makeLight(Kind::Camera, 0.7);
  renderer->AddLight(fill);
  renderer->AddLight(key);
  EXPECT_EQ(reasonOf(renderer, 0), "a headlight");
  EXPECT_EQ(reasonOf(renderer, 1), "it follows the camera, as does a brighter light that casts");
  key->SetDiffuseColor(0.0, 0.0, 1.0); // dimmer by its luminance
  EXPECT_EQ(reasonOf(renderer, 2), "it follows the camera, as does a brighter light that casts");
  EXPECT_EQ(reasonOf(renderer, 1), "");
  key->SwitchOff();
  EXPECT_EQ(reasonOf(renderer, 2), "switched off");
}

} // namespace
} // namespace gnomon::test
