// Several processes, each with a part of a scene, show the shadows that one process with all of it
// shows.

#include "SplitScene.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>

namespace gnomon::test
{
namespace
{

using Split = std::tuple<std::string, Distribution>;

class SharedPicture : public testing::Test
{
protected:
  tool::VtkMessages messages_;
};

class SharedPictureOf
  : public SharedPicture
  , public testing::WithParamInterface<Split>
{
};

INSTANTIATE_TEST_SUITE_P(Scenes, SharedPictureOf,
  testing::Combine(testing::Values("bunny", "atrium", "terrain", "posts"),
    testing::Values(blocks(), roundRobin(), random(), blocksWithGhosts())),
  [](const testing::TestParamInfo<Split>& split)
  { return std::get<0>(split.param) + "_" + std::get<1>(split.param).name; });

TEST_P(SharedPictureOf, EqualsThatOfOneProcess)
{
  SplitScene scene(tool::loadScene(std::get<0>(GetParam())), std::get<1>(GetParam()));
  EXPECT_GT(scene.expectSame(), 0u);
  scene.change([](vtkRenderer* renderer) { renderer->GetActiveCamera()->Azimuth(20.0); });
  EXPECT_GT(scene.expectSame(), 0u);
  scene.change(
    [](vtkRenderer* renderer)
    {
      auto* light = vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
      double position[3];
      light->GetPosition(position);
      light->SetPosition(position[0] + 0.5, position[1], position[2] + 0.7);
    });
  EXPECT_GT(scene.expectSame(), 0u);
  scene.change(
    [](vtkRenderer* renderer)
    {
      auto* last = renderer->GetActors()->GetLastActor();
      last->RotateZ(7.0);
      last->SetScale(1.1);
    });
  EXPECT_GT(scene.expectSame(), 0u);
  EXPECT_TRUE(this->messages_.errors().empty()) << this->messages_.errors().front();
}

TEST_F(SharedPicture, HasNoShadowsIfAProcessFailsAStage)
{
  SplitScene scene(tool::loadScene("posts"), blocks());
  const int last = controller()->GetNumberOfProcesses() - 1;
  if (controller()->GetLocalProcessId() == last)
  {
    scene.shared().pass->SetTracer(vtkGnomonShadowPass::TRACER_GPU); // which cannot share rays
  }
  scene.shared().draw();
  EXPECT_EQ(scene.shared().report().route, "none");
  ASSERT_EQ(this->messages_.errors().size(), 1u);
  const std::string& error = this->messages_.errors().front();
  EXPECT_THAT(error, testing::HasSubstr("The scene is drawn without shadows: "));
  EXPECT_THAT(error, testing::HasSubstr("the tracer on the GPU was asked for"));
  if (controller()->GetLocalProcessId() != last)
  {
    EXPECT_THAT(error, testing::HasSubstr("process " + std::to_string(last) + " of "));
  }

  scene.shared().pass->SetTracer(vtkGnomonShadowPass::TRACER_AUTO);
  EXPECT_GT(scene.expectSame(), 0u);
}

} // namespace
} // namespace gnomon::test
