#include "lights/vtkGnomonLightPlacement.h"

#include "VtkMessages.h"

#include <glm/glm.hpp>
#include <gmock/gmock.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <cmath>
#include <limits>

namespace gnomon::test
{
namespace
{

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

} // namespace
} // namespace gnomon::test
