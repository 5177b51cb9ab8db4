// Large scenes: memory stays bounded, and a change costs only the changed parts.

#include "PassScene.h"

#include <vtkShrinkPolyData.h>
#include <vtkTriangleFilter.h>

using namespace gnomon::test;

namespace
{

constexpr double mostBytesOfTriangle = 120.0;

/// A hilly square of side 1 from (x, y) on, of 2 * cells * cells triangles. Triangles share corners
/// or each have their own.
vtkSmartPointer<vtkPolyData> makeTerrain(
  int cells, double x, double y, double side, bool shared = true)
{
  const auto plane = planeOf({ x, y, 0.0 }, { x + side, y, 0.0 }, { x, y + side, 0.0 }, cells);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkShrinkPolyData> apart;
  apart->SetInputConnection(triangles->GetOutputPort());
  apart->SetShrinkFactor(1.0);
  const auto data = outputOf(shared ? triangles.Get() : static_cast<vtkAlgorithm*>(apart));
  data->GetPointData()->Initialize();
  movePoints(data,
    [](const glm::dvec3& at)
    { return glm::dvec3(at.x, at.y, 0.03 * std::sin(40.0 * at.x) * std::cos(31.0 * at.y)); });
  return data;
}

/// The camera sees little, so VTK draws little; but everything casts.
void lookAtCorner(PassScene& scene)
{
  scene.addSun({ 1.0, 0.3, -1.5 });
  scene.lookDown(0.05);
}

using Scale = PassTestOf<Way>;

INSTANTIATE_TEST_SUITE_P(Ways, Scale, fewWays, nameOf);

} // namespace

TEST_P(Scale, millionTrianglesTakeLessThanTheBound)
{
  for (const bool shared : { true, false })
  {
    PassScene scene(64, 64);
    scene.add(makeTerrain(708, 0.0, 0.0, 1.0, shared));
    lookAtCorner(scene);
    scene.render(GetParam());
    const gnomon::FrameReport& report = scene.report();
    ASSERT_GE(report.triangles, 1000000u);
    const double each =
      static_cast<double>(report.bytesOccluders) / static_cast<double>(report.triangles);
    EXPECT_LT(each, mostBytesOfTriangle) << shared;
    EXPECT_GT(each, shared ? 18.0 : 48.0) << "positions and indices alone take that";
  }
}

TEST_P(Scale, oneMovedPropOfTenThousandCostsItsOwnTriangles)
{
  constexpr int perSide = 100;
  PassScene scene(16, 16);
  vtkActor* moved = nullptr;
  for (int i = 0; i < perSide * perSide; ++i)
  {
    moved = scene.add(makeTerrain(1, i % perSide, i / perSide, 0.8));
  }
  lookAtCorner(scene);
  scene.choose(GetParam());
  const bool traced = std::string(GetParam().technique) == "raytraced";

  scene.render();
  EXPECT_EQ(scene.report().surfacesExtracted, perSide * perSide);
  EXPECT_EQ(scene.report().bvhBuilds, traced ? perSide * perSide : 0);
  EXPECT_LT(scene.report().bytesOccluders,
    mostBytesOfTriangle * static_cast<double>(scene.report().triangles) +
      1500.0 * perSide * perSide);

  scene.render();
  EXPECT_EQ(scene.report().surfacesExtracted, 0);
  EXPECT_EQ(scene.report().surfacesRetransformed, 0);
  EXPECT_EQ(scene.report().bvhBuilds + scene.report().bvhRefits + scene.report().mapBakes, 0);

  moved->SetPosition(-0.5, -0.5, 0.1);
  scene.render();
  EXPECT_EQ(scene.report().surfacesExtracted, 0);
  EXPECT_EQ(scene.report().surfacesRetransformed, 1);
  EXPECT_EQ(scene.report().bvhBuilds, 0);
  EXPECT_EQ(scene.report().bvhRefits, traced ? 1 : 0);
  EXPECT_EQ(scene.report().mapBakes, traced ? 0 : 1);
}
