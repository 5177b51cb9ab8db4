// Every kind of prop that VTK has, side by side (the built-in scene `props`): each casts and
// receives, or the report lists it.

#include "BuiltinPass.h"
#include "PassScene.h"

#include <vtkPropCollection.h>

using namespace gnomon::test;

namespace
{

/// Annotations neither cast nor receive, and nothing is said of them.
bool isAnnotation(const std::string& name)
{
  return name == "text" || name == "axes" || name == "annotated cube";
}

/// Glass casts only if asked, and its shadows are not wholly dark.
bool isGlass(const std::string& name)
{
  return name == "glass ball" || name == "stained pane";
}

class KindsOfProps : public PassTestOf<const char*>
{
protected:
  /// The colour under ambient light alone.
  static constexpr glm::ivec3 darkGroundColour{ 38, 38, 37 };

  KindsOfProps()
  {
    this->scene.pass->SetTechnique(GetParam());
    this->scene.pass->KeepVisibilityOff();
  }

  /// Counts of a frame.
  struct Shown
  {
    std::size_t darkGround = 0;   ///< pixels of the picture with the ground's colour in shadow
    std::size_t brightPixels = 0; ///< brighter than that
    std::string leftOut;          ///< the notes on props that neither cast nor receive
  };

  Shown draw()
  {
    const Picture picture = this->scene.render();
    Shown shown;
    shown.darkGround = countPixels(picture,
      [&](int x, int y)
      {
        const glm::ivec3 off = glm::abs(picture.at(x, y) - darkGroundColour);
        return std::max({ off.r, off.g, off.b }) <= 1;
      });
    shown.brightPixels = countPixels(picture,
      [&](int x, int y)
      {
        const glm::ivec3 colour = picture.at(x, y);
        return std::max({ colour.r, colour.g, colour.b }) > 60;
      });
    for (const std::string& note : this->scene.pass->GetReport().notes)
    {
      shown.leftOut += note.find("neither cast") != std::string::npos ? note + "\n" : "";
    }
    return shown;
  }

  /// Draw without one prop after the other, and call `check` with its name and the frame's counts.
  template <typename Check>
  void hideEach(const Check& check)
  {
    const std::vector<gnomon::tool::SceneProp> props = gnomon::tool::loadScene("props").props;
    ASSERT_EQ(props.size(), 30u);
    vtkPropCollection* all = this->scene.renderer->GetViewProps();
    for (std::size_t i = 0; i < props.size(); ++i)
    {
      SCOPED_TRACE(props[i].name);
      // The ground is prop 0.
      auto* prop = vtkProp::SafeDownCast(all->GetItemAsObject(static_cast<int>(i) + 1));
      prop->VisibilityOff();
      check(props[i].name, this->draw());
      prop->VisibilityOn();
    }
  }

  BuiltinPass scene{ "props", 320 };
};

INSTANTIATE_TEST_SUITE_P(
  By, KindsOfProps, testing::Values("nsm", "silhouette", "raytraced", "penumbra"), byText);

} // namespace

TEST_P(KindsOfProps, castOrAreListed)
{
  const Shown all = this->draw();
  this->hideEach(
    [&](const std::string& name, const Shown& without)
    {
      // Without the prop, bounds and texels differ, so a few pixels at other shadows' edges change.
      const bool casts = without.darkGround + 30 < all.darkGround;
      const bool isListed = without.leftOut != all.leftOut;
      EXPECT_EQ(casts, !isListed && !isAnnotation(name) && !isGlass(name) && name != "volume");
    });
}

/// A plate hides the sun from everything and nothing from the camera.
TEST_P(KindsOfProps, receiveOrAreListed)
{
  this->scene.renderer->AddActor(actorOf(
    mapperOf(planeOf({ -40.0, 20.0, -40.0 }, { 40.0, 20.0, -40.0 }, { -40.0, 20.0, 40.0 }))));
  this->scene.renderer->SetBackground(0.0, 0.0, 0.0);
  const Shown all = this->draw();
  this->hideEach(
    [&](const std::string& name, const Shown& without)
    {
      const bool isLit = without.brightPixels < all.brightPixels;
      const bool isListed = without.leftOut != all.leftOut;
      EXPECT_EQ(
        isLit, isListed || name == "unlit" || isAnnotation(name) || name == "Gaussian points");
    });
}
