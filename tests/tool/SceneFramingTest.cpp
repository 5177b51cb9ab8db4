#include "SceneFraming.h"
#include "MeshBuilder.h"

#include <gtest/gtest.h>

namespace gnomon::tool
{

namespace
{

/// The depths of a model, seen along -z from height 2 with 90 degrees between the upper and the
/// lower border.
DepthRange depthsOf(const SceneModel& model, double aspect)
{
  Scene scene;
  scene.models = { model };
  scene.camera = makeCamera({ 0.0, 2.0, 0.0 }, { 0.0, 2.0, -1.0 }, 90.0);
  return visibleDepths(scene, aspect);
}

SceneModel makeBox(const Vec3& low, const Vec3& high)
{
  MeshBuilder mesh;
  mesh.addBox(low, high);
  return makeModel("box", mesh.build(), { 1.0, 1.0, 1.0 });
}

} // namespace

TEST(VisibleDepths, AreOfWhatIsInThePicture)
{
  const SceneModel ground = makePlane(origin, 200.0);
  // At 45 degrees to the right of the view it begins at depth 3, at depth 1 it is out of a square
  // picture, but not of one three times as wide as high.
  const SceneModel beside = makeBox({ 3.0, 1.0, -10.0 }, { 4.0, 3.0, 5.0 });
  SceneModel moved = makeBox({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 });
  moved.matrix = { 2, 0, 0, 0, 0, 2, 0, 2, 0, 0, 2, -8, 0, 0, 0, 1 };
  struct Case
  {
    const char* name;
    const SceneModel& model;
    double aspect, nearest, farthest;
  };
  for (const Case& of : { Case{ "from the lower border", ground, 1.0, 2.0, 100.0 },
         Case{ "beside a square", beside, 1.0, 3.0, 10.0 }, Case{ "wide", beside, 3.0, 1.0, 10.0 },
         Case{ "by a matrix", moved, 1.0, 6.0, 10.0 } })
  {
    const DepthRange depths = depthsOf(of.model, of.aspect);
    EXPECT_NEAR(depths.nearest, of.nearest, 1e-6) << of.name;
    EXPECT_NEAR(depths.farthest, of.farthest, 1e-7 * of.farthest) << of.name;
  }
  const DepthRange none = depthsOf(makeBox({ -1.0, 1.0, 2.0 }, { 1.0, 3.0, 3.0 }), 1.0);
  EXPECT_LT(none.farthest, none.nearest) << "behind the eye";
}

} // namespace gnomon::tool
