// Several processes, each with a part of a scene, show the shadows that one process with all of it
// shows.

#include "SplitScene.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>

#include <gtest/gtest.h>

#include <string>
#include <tuple>

namespace gnomon::test
{
namespace
{

using Split = std::tuple<std::string, Distribution>;

class SharedPicture : public testing::TestWithParam<Split>
{
protected:
  tool::VtkMessages messages_;
};

INSTANTIATE_TEST_SUITE_P(Scenes, SharedPicture,
  testing::Combine(testing::Values("bunny", "atrium", "terrain", "posts"),
    testing::Values(blocks(), roundRobin(), random(), blocksWithGhosts())),
  [](const testing::TestParamInfo<Split>& split)
  { return std::get<0>(split.param) + "_" + std::get<1>(split.param).name; });

TEST_P(SharedPicture, EqualsThatOfOneProcess)
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

} // namespace
} // namespace gnomon::test
