#include "SceneFraming.h"
#include "MeshBuilder.h"

#include <gtest/gtest.h>

namespace gnomon::tool
{

namespace
{

/// Looks along -z from height 2 with 90 degrees between the upper and the lower border.
Scene makeSceneFromHeight(std::vector<SceneModel> models)
{
  Scene scene;
  scene.models = std::move(models);
  scene.camera = makeCamera({ { 0.0, 2.0, 0.0 } }, { { 0.0, 2.0, -1.0 } }, 90.0);
  return scene;
}

SceneModel makeBox(const Vec3& low, const Vec3& high)
{
  MeshBuilder mesh;
  mesh.addBox(low, high);
  return makeModel("box", mesh.build(), { { 1.0, 1.0, 1.0 } });
}

} // namespace

//------------------------------------------------------------------------------
TEST(VisibleDepths, GroundUnderTheEyeBeginsAtTheLowerBorder)
{
  const Scene scene = makeSceneFromHeight({ makePlane({ { 0.0, 0.0, 0.0 } }, 200.0) });
  const DepthRange depths = visibleDepths(scene, 1.0);
  EXPECT_NEAR(depths.nearest, 2.0, 1e-6);
  EXPECT_NEAR(depths.farthest, 100.0, 1e-4);
}

//------------------------------------------------------------------------------
TEST(VisibleDepths, ModelsBesideThePictureDoNotCount)
{
  // At 45 degrees to the right of the view it begins at depth 3, at depth 1 it is out of a square
  // picture, but not of one three times as wide as high.
  const Scene scene =
    makeSceneFromHeight({ makeBox({ { 3.0, 1.0, -10.0 } }, { { 4.0, 3.0, 5.0 } }) });
  EXPECT_NEAR(visibleDepths(scene, 1.0).nearest, 3.0, 1e-6);
  EXPECT_NEAR(visibleDepths(scene, 3.0).nearest, 1.0, 1e-6);
  EXPECT_NEAR(visibleDepths(scene, 1.0).farthest, 10.0, 1e-6);
}

//------------------------------------------------------------------------------
TEST(VisibleDepths, FollowTheModelsMatrix)
{
  Scene scene = makeSceneFromHeight({ makeBox({ { -1.0, -1.0, -1.0 } }, { { 1.0, 1.0, 1.0 } }) });
  scene.models[0].matrix = { 2.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 2.0, 0.0, 0.0, 2.0, -8.0, 0.0, 0.0,
    0.0, 1.0 };
  const DepthRange depths = visibleDepths(scene, 1.0);
  EXPECT_NEAR(depths.nearest, 6.0, 1e-6);
  EXPECT_NEAR(depths.farthest, 10.0, 1e-6);
}

//------------------------------------------------------------------------------
TEST(VisibleDepths, AreEmptyWhereNothingIsSeen)
{
  const Scene scene =
    makeSceneFromHeight({ makeBox({ { -1.0, 1.0, 2.0 } }, { { 1.0, 3.0, 3.0 } }) });
  const DepthRange depths = visibleDepths(scene, 1.0);
  EXPECT_LT(depths.farthest, depths.nearest);
}

} // namespace gnomon::tool
