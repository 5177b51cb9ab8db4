#include "LitPlane.h"

#include <vtkTransform.h>

#include <cmath>

namespace gnomon::test
{

//------------------------------------------------------------------------------
void expectNoAcneUnderTheSun(const Choose& choose, const std::vector<double>& degrees)
{
  for (const int mapSize : { 64, 1024 })
  {
    PassScene scene(200, 200);
    scene.addFloor(4.0);
    vtkLight* sun = scene.addSun({ 0.0, 0.0, -1.0 });
    choose(scene, sun);
    scene.pass->SetMapSize(mapSize);
    scene.lookFrom({ 1.0, -7.0, 6.0 });
    for (const double degree : degrees)
    {
      const double angle = glm::radians(degree);
      const glm::dvec3 toLight(0.8 * std::sin(angle), 0.6 * std::sin(angle), std::cos(angle));
      sun->SetPosition(toLight.x, toLight.y, toLight.z);
      const Acne acne = countAcneOfSun(drawKept(scene), toLight);
      EXPECT_GT(acne.facing, 10000u);
      EXPECT_EQ(acne.dark, 0u) << degree << " degrees, map " << mapSize;
    }
  }
}

//------------------------------------------------------------------------------
void checkAlongALongPlane(
  const Choose& choose, const std::vector<double>& degrees, const CheckSun& check)
{
  for (const int mapSize : { 64, 256 })
  {
    PassScene scene(150, 150);
    scene.addFloor(100.0);
    vtkLight* sun = scene.addSun({ 0.0, 0.0, -1.0 });
    choose(scene, sun);
    scene.pass->SetMapSize(mapSize);
    scene.lookFrom({ 3.0, -98.0, 2.0 }, { 0.0, 0.0, 0.0 });
    for (const double degree : degrees)
    {
      for (const double turn : { 10.0, 80.0, 190.0, 260.0 })
      {
        const double angle = glm::radians(degree);
        const double around = glm::radians(turn);
        const glm::dvec3 toLight(
          std::cos(around) * std::sin(angle), std::sin(around) * std::sin(angle), std::cos(angle));
        sun->SetPosition(toLight.x, toLight.y, toLight.z);
        check(drawKept(scene), toLight,
          std::to_string(degree) + " degrees, turned by " + std::to_string(turn) + ", map " +
            std::to_string(mapSize));
      }
    }
  }
}

//------------------------------------------------------------------------------
void expectNoAcneAlongALongPlane(const Choose& choose, const std::vector<double>& degrees)
{
  checkAlongALongPlane(choose, degrees,
    [](const VisibilityImages& kept, const glm::dvec3& toLight, const std::string& where)
    {
      const Acne acne = countAcneOfSun(kept, toLight);
      EXPECT_GT(acne.facing, 5000u);
      EXPECT_EQ(acne.dark, 0u) << where;
    });
}

//------------------------------------------------------------------------------
void expectNoAcneUnderASpot(const Choose& choose, const std::vector<double>& conesDegrees)
{
  for (const double cone : conesDegrees)
  {
    for (const int mapSize : { 64, 1024 })
    {
      PassScene scene(200, 200);
      scene.addFloor(4.0);
      scene.lookFrom({ 1.0, -7.0, 6.0 });
      vtkLight* spot = scene.addSpot({ 0.0, 0.0, 3.0 }, glm::dvec3(0.0), cone);
      choose(scene, spot);
      scene.pass->SetMapSize(mapSize);
      for (const double height : { 3.0, 1.0, 0.3, 0.1 })
      {
        const glm::dvec3 light(-3.0, -2.0, height);
        spot->SetPosition(light.x, light.y, light.z);
        const glm::dvec3 axis = glm::normalize(-light);
        const Acne acne = countAcne(drawKept(scene),
          [&](const glm::dvec3& point)
          {
            // Half a degree inside, where rounding does not decide.
            const glm::dvec3 toPoint = glm::normalize(point - light);
            const bool inCone = glm::dot(toPoint, axis) > std::cos(glm::radians(cone - 0.5));
            return inCone ? -toPoint : glm::dvec3(0.0);
          });
        EXPECT_GT(acne.facing, 5000u);
        EXPECT_EQ(acne.dark, 0u) << "cone " << cone << ", height " << height << ", map " << mapSize;
      }
    }
  }
}

//------------------------------------------------------------------------------
void addTrough(PassScene& scene)
{
  scene.addFloor(2.0);
  for (const glm::dvec2& side : { glm::dvec2(-1.0, 0.0), { 0.0, -1.0 } })
  {
    vtkNew<vtkTransform> stand;
    stand->Translate(2.0 * side.x, 2.0 * side.y, 2.0);
    stand->RotateWXYZ(90.0, side.y, -side.x, 0.0);
    scene.addFloor(2.0)->SetUserTransform(stand);
  }
}

//------------------------------------------------------------------------------
void expectNoAcneInATrough(const Choose& choose, const std::vector<int>& mapSizes)
{
  for (const int mapSize : mapSizes)
  {
    for (const glm::dvec3& direction :
      { glm::dvec3(-1.0, -0.8, -1.0), { -0.3, -1.0, -0.1 }, { -0.1, -0.1, -1.0 } })
    {
      PassScene scene(200, 200);
      addTrough(scene);
      choose(scene, scene.addSun(direction));
      scene.pass->SetMapSize(mapSize);
      scene.lookFrom({ 8.0, 9.0, 7.0 });
      const Acne acne = countAcneOfSun(drawKept(scene), -direction);
      EXPECT_GT(acne.facing, 8000u);
      EXPECT_EQ(acne.dark, 0u) << "map " << mapSize << ", sun along " << direction.x;
    }
  }
}

} // namespace gnomon::test
