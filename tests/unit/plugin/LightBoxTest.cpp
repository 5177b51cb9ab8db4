// Directional lights limited to a box.

#include "PassScene.h"

#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>

using namespace gnomon::test;
using testing::HasSubstr;

namespace
{

/// A light at 45 degrees along +x over a floor, whose box begins around (-3, 0, 3).
struct LightBox : PassTestOf<Way>
{
  static constexpr double width = 3.0;
  static constexpr double height = 4.0;
  const glm::dvec3 start{ -3.0, 0.0, 3.0 };
  const glm::dvec3 travel = glm::normalize(glm::dvec3(1.0, 0.0, -1.0));
  const double up[3] = { 0.0, 2.0, 0.0 };

  LightBox()
  {
    this->scene.addFloor(5.0);
    this->scene.choose(GetParam());
    this->scene.lookDown(4.5);
    this->light = this->scene.addSun(this->travel);
    aim(this->light, this->start);
  }

  void addCaster(const Box& caster)
  {
    this->scene.addBox(caster.lower, caster.upper);
    this->casters.push_back(caster);
  }

  /// Return the exact answer for the floor, with the light's box this deep.
  ExactFloor exact(double depth) const
  {
    return [this, depth](const glm::dvec2& floor)
    {
      for (const Box& caster : this->casters)
      {
        if (isUnder(floor, { caster.lower - 0.05, caster.upper + 0.05 }))
        {
          return -1.0;
        }
      }
      const glm::dvec3 fromStart = glm::dvec3(floor, 0.0) - this->start;
      const double along = glm::dot(fromStart, this->travel);
      const double across = glm::dot(fromStart, glm::normalize(glm::dvec3(1.0, 0.0, 1.0)));
      const bool inBox =
        along <= depth && std::abs(across) <= 0.5 * width && std::abs(floor.y) <= 0.5 * height;
      const bool shadow = std::any_of(this->casters.begin(), this->casters.end(),
        [&](const Box& caster) { return hitsBox(floor, -this->travel, caster, along); });
      return inBox && !shadow ? 180.0 : 0.0; // 255 times the cosine of 45 degrees
    };
  }

  PassScene scene{ 300, 300 };
  vtkLight* light;
  std::vector<Box> casters;
};

INSTANTIATE_TEST_SUITE_P(Ways, LightBox, allWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnPlanes, LightBox, testing::Values(planarWay), nameOf);

} // namespace

TEST_P(LightBox, lightsAndCastsWithinOnly)
{
  this->addCaster({ { -0.5, -0.5, 0.5 }, { 0.5, 0.5, 1.0 } });   // inside
  this->addCaster({ { -4.5, -1.5, 4.0 }, { -4.0, -1.0, 4.5 } }); // before the near face
  this->addCaster({ { -3.3, 1.0, 2.7 }, { -2.7, 1.3, 3.3 } });   // across it
  this->addCaster({ { -0.2, 1.9, 0.3 }, { 0.2, 2.5, 0.6 } });    // across a side
  this->addCaster({ { 2.4, 0.2, 0.3 }, { 2.8, 0.6, 0.9 } });     // beside
  for (const double depth : { 9.0, 4.5 }) // past the floor, and above a part of it
  {
    vtkGnomonLightKeys::SetBox(this->light, width, height, depth, this->up);
    expectRight(checkFloor(this->scene, this->scene.render(), this->exact(depth), 0.06), 50000);
  }
  // Without the box, the casters outside cast, and the light reaches all of the floor.
  vtkGnomonLightKeys::RemoveBox(this->light);
  const FloorCheck check = checkFloor(this->scene, this->scene.render(), this->exact(9.0), 0.06);
  EXPECT_GT(check.falseLight, 10000u);
  EXPECT_GT(check.falseShadow, 100u);
}

TEST_P(LightBox, withoutCastersStillEnds)
{
  vtkGnomonLightKeys::SetBox(this->light, width, height, 9.0, this->up);
  vtkGnomonPropKeys::SetCasts(this->scene.renderer->GetActors()->GetLastActor(), false);
  expectRight(checkFloor(this->scene, this->scene.render(), this->exact(9.0), 0.06), 50000);
  vtkGnomonLightKeys::SetBox(this->light, width, height, 2.0, this->up); // ends above the floor
  EXPECT_EQ(this->scene.redAt(this->scene.render(), 0.0, 0.0), 0);
}

TEST_P(LightBox, turnsWithItsLight)
{
  this->addCaster({ { -0.5, -0.5, 0.5 }, { 0.5, 0.5, 1.0 } });
  const double askew[3] = { 0.2, 1.0, 0.7 };
  vtkGnomonLightKeys::SetBox(this->light, width, height, 9.0, askew);
  vtkNew<vtkTransform> turn;
  turn->RotateZ(50.0);
  turn->RotateX(20.0);
  this->light->SetTransformMatrix(turn->GetMatrix());
  const Picture turned = this->scene.render();
  double position[3];
  double focalPoint[3];
  this->light->GetTransformedPosition(position);
  this->light->GetTransformedFocalPoint(focalPoint);
  this->light->SetTransformMatrix(nullptr);
  this->light->SetPosition(position);
  this->light->SetFocalPoint(focalPoint);
  vtkGnomonLightKeys::SetBox(this->light, width, height, 9.0, turn->TransformDoubleVector(askew));
  EXPECT_LE(differingPixels(turned, this->scene.render(), 2), 4u);
}

TEST_P(LightBox, sizesThatAreNoneAreAnError)
{
  const double inf = std::numeric_limits<double>::infinity();
  const double none[3] = { 0.0, 0.0, 0.0 };
  for (const glm::dvec3& size :
    { glm::dvec3(0.0, 1.0, 1.0), { 1.0, -1.0, 1.0 }, { 1.0, 1.0, inf } })
  {
    vtkGnomonLightKeys::SetBox(this->light, size.x, size.y, size.z, this->up);
    EXPECT_THAT(this->takeErrors(), HasSubstr("expected positive and finite numbers"));
  }
  vtkGnomonLightKeys::SetBox(this->light, 1.0, 1.0, 1.0, none);
  EXPECT_THAT(this->takeErrors(), HasSubstr("have up ("));
  EXPECT_FALSE(this->light->GetInformation()->Has(vtkGnomonLightKeys::BOX()));
}
