// Kind of prop x kind of change: the next picture is that of a new pass, and what refines restarts
// once.

#include "ChangingProps.h"
#include "PassScene.h"

#include "plugin/vtkGnomonLightSamplingPass.h"

namespace gnomon::test
{
namespace
{

/// A prop above a ground whose left half is in the shadow of a roof out of view.
struct ChangingScene : PassScene
{
  explicit ChangingScene(const PropKind& kind)
    : PassScene(80, 60)
  {
    this->addFloor(3.0);
    this->addBox({ -3.0, -3.0, 8.0 }, { 0.0, 3.0, 8.1 });
    vtkLight* const lamp = this->addSpot({ 0.0, 0.0, 9.0 }, glm::dvec3(0.0), allDirections);
    vtkGnomonLightKeys::SetSetting(lamp, "light_radius", "0.1");
    this->lookFrom({ 0.0, -3.0, 6.0 });
    this->prop = kind.make(this->renderer);
    this->renderer->AddViewProp(this->prop.prop);
  }
  /// Draw by a pass without earlier frames.
  Picture renderAnew()
  {
    this->fresh = vtkSmartPointer<vtkGnomonShadowPass>::New();
    test::choose(this->fresh, tracedWay);
    this->fresh->SetSetting("light_radius", "0");
    this->renderer->SetPass(this->fresh);
    return this->render();
  }

  ChangingProp prop;
  vtkSmartPointer<vtkGnomonShadowPass> fresh;
};

/// Call `check` for each kind of prop of a half after each kind of change.
/// @param begin called with each scene before its changes
void changeAll(int half, const std::function<void(ChangingScene&)>& begin,
  const std::function<void(ChangingScene&)>& check)
{
  const std::vector<PropKind>& kinds = changingProps();
  for (std::size_t i = half * kinds.size() / 2; i < (half + 1) * kinds.size() / 2; ++i)
  {
    ChangingScene scene(kinds[i]);
    begin(scene);
    for (const PropChange& change : propChanges())
    {
      SCOPED_TRACE(std::string(kinds[i].name) + ", " + change.name);
      if (change.apply(scene.prop))
      {
        check(scene);
      }
    }
  }
}

/// With the number of a half of the kinds.
using PropChanges = PassTestOf<int>;
INSTANTIATE_TEST_SUITE_P(Halves, PropChanges, testing::Range(0, 2));

} // namespace

/// Compare the picture after each change with that of a new pass, which goes on.
TEST_P(PropChanges, showInTheNextFrame)
{
  std::size_t changed = 0;
  Picture before;
  const auto begin = [&](ChangingScene& scene)
  {
    scene.renderAnew();
    before = scene.render();
  };
  const auto check = [&](ChangingScene& scene)
  {
    const Picture live = scene.render();
    const Picture fresh = scene.renderAnew();
    EXPECT_EQ(differingPixels(live, fresh), 0u);
    changed += differingPixels(before, fresh) > 0 ? 1 : 0;
    before = fresh;
    scene.render();
    scene.render();
    EXPECT_EQ(scene.fresh->GetReport().receiversDrawn, 0) << "nothing changes";
  };
  changeAll(GetParam(), begin, check);
  EXPECT_GT(changed, 100u);
}

/// Samples of lights restart after each change, and then come to an end.
TEST_P(PropChanges, restartSamples)
{
  vtkSmartPointer<vtkGnomonLightSamplingPass> sampling;
  const auto finish = [&](ChangingScene& scene)
  {
    for (int frame = 0; frame < 3; ++frame)
    {
      scene.window->Render();
    }
    EXPECT_EQ(sampling->GetProgress(), 1.0);
  };
  const auto begin = [&](ChangingScene& scene)
  {
    sampling = vtkSmartPointer<vtkGnomonLightSamplingPass>::New();
    sampling->SetSamples(2);
    sampling->SetSamplesPerFrame(2);
    scene.renderer->SetPass(sampling);
    finish(scene);
  };
  const auto check = [&](ChangingScene& scene)
  {
    scene.window->Render();
    EXPECT_EQ(sampling->GetProgress(), 0.0);
    finish(scene);
  };
  changeAll(GetParam(), begin, check);
}

TEST_F(PassTest, changesOfUnknownKindsAreSaidToBeUncertain)
{
  const auto hint = testing::HasSubstr("only VTK's redraw time tells of changes of ");
  for (const PropKind& kind : changingProps())
  {
    ChangingScene scene(kind);
    scene.renderAnew();
    const bool isUnknown = kind.name == std::string("axes") || kind.name == std::string("restless");
    EXPECT_THAT(scene.fresh->GetReport().notes, testing::Contains(hint).Times(isUnknown ? 1 : 0))
      << kind.name;
  }
}

} // namespace gnomon::test
