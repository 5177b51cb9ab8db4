// `gnomon view` on an X server: keys and mouse as the window tells of them, its pictures, and the
// same pictures without a screen.

#include "view/Viewer.h"
#include "Errors.h"
#include "TestFiles.h"
#include "VtkMessages.h"

#include "lights/vtkGnomonVersions.h"
#include "shadowtech/base/Gl.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>

using testing::HasSubstr;
using testing::Not;

namespace gnomon::tool
{
namespace
{

std::size_t differingPixels(const Picture& a, const Picture& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixelCount(); ++i)
  {
    count += !std::equal(&a.rgb[3 * i], &a.rgb[3 * i] + 3, &b.rgb[3 * i]);
  }
  return a.pixelCount() == b.pixelCount() ? count : a.pixelCount();
}

/// The first pixel below the text and its legend.
std::size_t firstBelow(const Picture& picture)
{
  return picture.pixelCount() * 2 / 5;
}

/// How many pixels below the text have a colour.
std::int64_t countBelow(const Picture& picture, const std::array<unsigned char, 3>& colour)
{
  std::int64_t count = 0;
  for (std::size_t i = firstBelow(picture); i < picture.pixelCount(); ++i)
  {
    count += std::equal(colour.begin(), colour.end(), &picture.rgb[3 * i]);
  }
  return count;
}

/// The picture below the text.
std::vector<unsigned char> below(const Picture& picture)
{
  return { &picture.rgb[3 * firstBelow(picture)], picture.rgb.data() + picture.rgb.size() };
}

/// A viewer on the X server, and a folder that it saves to. Neither VTK nor OpenGL may complain.
class ViewerTest : public testing::Test
{
protected:
  void SetUp() override { ASSERT_NE(std::getenv("DISPLAY"), nullptr) << "run under xvfb-run"; }
  void TearDown() override
  {
    this->expectSilence();
    this->close();
  }
  /// VTK 9.3 visits interactors until they are done, also those that are gone.
  void close()
  {
    if (this->viewer)
    {
      const vtkSmartPointer<vtkRenderWindowInteractor> interactor = this->viewer->interactor();
      this->viewer.reset();
      interactor->SetDone(true);
      interactor->ProcessEvents();
    }
  }

  void view(const std::string& name, std::vector<std::string> techniques)
  {
    Scene scene = loadScene(name);
    ViewState state = initialState(name, scene);
    state.size = { 320, 240 };
    state.technique = techniques.front();
    this->view(std::move(scene), state, std::move(techniques));
  }
  void view(Scene scene, const ViewState& state, std::vector<std::string> techniques)
  {
    this->viewer = std::make_unique<Viewer>(
      std::move(scene), state, ViewChoices{ std::move(techniques) }, this->folder / "shot");
    this->viewer->open();
  }
  /// The picture after these keys.
  Picture press(const std::string& keys)
  {
    this->viewer->press(keys);
    this->expectSilence();
    return capture(this->viewer->window());
  }
  void save(const std::string& keys)
  {
    this->press(keys);
    this->viewer->save();
    this->expectSilence();
  }
  /// Every saved picture is what its settings say, drawn without a screen.
  /// @return how many there are
  int drawAgain()
  {
    const Scene scene = loadScene(this->state().scene);
    this->close(); // one thread holds a GLX or an EGL context, not both
    int count = 0;
    for (int i = 1; std::filesystem::exists(this->shot(i) + ".json"); ++i)
    {
      const ViewState state = parseState(readBytes(this->shot(i) + ".json"), "file", scene);
      const Picture again = drawWithoutScreen(state, scene);
      EXPECT_EQ(differingPixels(again, readPicture(this->shot(i) + ".png")), 0u) << textOf(state);
      ++count;
    }
    return count;
  }
  void expectSilence()
  {
    EXPECT_THAT(this->messages.errors(), testing::IsEmpty());
    EXPECT_THAT(this->messages.warnings(), testing::IsEmpty());
    if (this->viewer)
    {
      this->viewer->window()->MakeCurrent();
      EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
  }

  std::string shot(int number) { return this->folder / ("shot-" + std::to_string(number)); }
  std::string corner() { return this->viewer->view().cornerText(); }
  ViewState state() { return this->viewer->view().state(); }

  /// Moves the mouse to a pixel, row 0 at the bottom.
  void moveTo(int x, int y)
  {
    this->viewer->interactor()->SetEventInformation(x, y);
    this->viewer->interactor()->InvokeEvent(vtkCommand::MouseMoveEvent);
  }
  void mouse(unsigned long event) { this->viewer->interactor()->InvokeEvent(event); }
  /// Where the handle's ball is in the picture.
  std::array<int, 2> ball()
  {
    double place[3];
    this->viewer->view().handle().ball()->GetDisplayPosition(place);
    return { static_cast<int>(std::lround(place[0])), static_cast<int>(std::lround(place[1])) };
  }

  TestFolder folder;
  VtkMessages messages;
  std::unique_ptr<Viewer> viewer;
};

TEST_F(ViewerTest, SwitchesTechniqueTruthAndErrorInPlace)
{
  this->view("bunny", { "nsm", "raytraced" });
  this->press("d"); // no handle in the pictures
  const auto still = [this] { return this->viewer->view().still(); };
  const Picture nsm = still();
  this->press(" ");
  EXPECT_EQ(this->state().show, Show::Truth);
  const Picture truth = still();
  const std::size_t wrong = differingPixels(nsm, truth);
  EXPECT_GT(wrong, 20u);
  EXPECT_LT(wrong, nsm.pixelCount() / 4);

  const Picture errors = this->press(" ");
  EXPECT_EQ(this->state().show, Show::Error);
  ASSERT_TRUE(this->viewer->view().pass()->error());
  const VisibilityError error = *this->viewer->view().pass()->error();
  EXPECT_GT(error.wrongPixels(), 20);
  EXPECT_LE(static_cast<std::size_t>(error.wrongPixels()), wrong);
  EXPECT_THAT(
    this->corner(), HasSubstr("wrong pixels: " + std::to_string(error.wrongPixels()) + " ("));
  const std::int64_t shown =
    countBelow(errors, { 64, 128, 255 }) + countBelow(errors, { 255, 48, 48 });
  EXPECT_GT(shown, error.wrongPixels() / 2);
  EXPECT_LE(shown, error.wrongPixels());

  // The truth is right, as seen by itself.
  this->press("]");
  EXPECT_EQ(this->state().technique, "raytraced");
  EXPECT_THAT(this->corner(), HasSubstr("wrong pixels: 0 "));
  this->press(" ");
  EXPECT_EQ(this->state().show, Show::Technique);
  const Picture traced = still();
  this->press(" ");
  EXPECT_TRUE(below(still()) == below(traced));
  this->press("]");
  EXPECT_EQ(this->state().technique, "nsm");
  this->press("[");
  EXPECT_EQ(this->state().technique, "raytraced");
}

TEST_F(ViewerTest, TheHandleComesBackWithItsBall)
{
  this->view("bunny", { "nsm" });
  const Picture back = this->press("dd");
  EXPECT_TRUE(below(this->viewer->view().still()) == below(back));
}

TEST_F(ViewerTest, SavesWhatTheHeadlessProgramDrawsByteForByte)
{
  this->view("bunny", { "pssm", "silhouette", "auto" });
  for (const char* keys : { "", "v", "x", "h ", "  ", "hvik", "]k  .", "d]" })
  {
    this->save(keys);
  }
  EXPECT_EQ(this->drawAgain(), 8);
}

TEST_F(ViewerTest, ARestingSceneDrawsNothing)
{
  this->view("bunny", { "auto", "penumbra" });
  this->press("] ");
  const auto rest = [this]
  {
    for (int i = 0; i < 8; ++i)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      this->viewer->interactor()->ProcessEvents();
    }
  };
  rest(); // what the window system still has to tell
  const int frames = this->viewer->view().framesDrawn();
  rest();
  EXPECT_EQ(this->viewer->view().framesDrawn(), frames);
  this->moveTo(100, 100); // with nothing under the cursor that is asked for
  EXPECT_EQ(this->viewer->view().framesDrawn(), frames);
  this->press("h");
  EXPECT_EQ(this->viewer->view().framesDrawn(), frames + 1);
}

TEST_F(ViewerTest, TheProbeSaysWhatIsInTheWay)
{
  this->view("bunny", { "silhouette" });
  this->press("i");
  const auto saysAt = [this](int x, int y)
  {
    this->moveTo(x, y);
    return this->corner();
  };
  EXPECT_THAT(saysAt(10, 10), HasSubstr("light 0: 1"));
  EXPECT_THAT(saysAt(10, 10), HasSubstr("nothing before its middle"));
  EXPECT_THAT(saysAt(100, 75), HasSubstr("light 0: 0"));
  EXPECT_THAT(saysAt(100, 75), HasSubstr("behind bunny, triangle "));
  EXPECT_THAT(saysAt(10, 230), HasSubstr("no surface"));
  EXPECT_THAT(saysAt(320, 0), HasSubstr("outside of the picture"));
  this->press("i");
  EXPECT_THAT(this->corner(), Not(HasSubstr("light 0")));
}

TEST_F(ViewerTest, TheHandleMovesTheLightAndTheWheelSizesIt)
{
  this->view("bunny", { "raytraced" });
  const Picture before = this->viewer->view().still();
  const ViewState first = this->state();
  const auto [x, y] = this->ball();
  this->moveTo(x, y);
  this->mouse(vtkCommand::LeftButtonPressEvent);
  this->moveTo(x - 20, y);
  this->moveTo(x - 60, y + 10);
  this->mouse(vtkCommand::LeftButtonReleaseEvent);
  this->expectSilence();
  const ViewState dragged = this->state();
  EXPECT_NE(dragged.lights[0].position, first.lights[0].position);
  EXPECT_EQ(dragged.camera.position, first.camera.position);
  EXPECT_GT(differingPixels(before, this->viewer->view().still()), 1000u);
  const auto [newX, newY] = this->ball();
  EXPECT_NEAR(newX, x - 60, 25); // on the dome, nearest to the cursor
  EXPECT_NEAR(newY, y + 10, 25);

  this->moveTo(newX, newY);
  for (int i = 0; i < 4; ++i)
  {
    this->mouse(vtkCommand::MouseWheelForwardEvent);
  }
  const double grown = this->state().lights[0].size;
  EXPECT_GT(grown, 0.25);
  this->mouse(vtkCommand::MouseWheelBackwardEvent);
  EXPECT_LT(this->state().lights[0].size, grown);
  EXPECT_EQ(this->state().camera.position, first.camera.position);
  this->save(" ");

  this->moveTo(10, 10);
  this->mouse(vtkCommand::MouseWheelForwardEvent);
  EXPECT_NE(this->state().camera.position, first.camera.position); // VTK's dolly
  this->expectSilence();
  this->save("  ");
  EXPECT_EQ(this->drawAgain(), 2);
}

TEST_F(ViewerTest, KeysOfVtkKeepTheirMeaning)
{
  this->view("cube", { "raytraced" });
  const Vec3 position = this->state().camera.position;
  this->press("r");
  EXPECT_NE(this->state().camera.position, position);
  const Picture plain = this->viewer->view().still();
  this->press("3");
  EXPECT_TRUE(this->state().stereo);
  EXPECT_GT(differingPixels(plain, this->viewer->view().still()), 100u);
  this->save("");
  this->press("3");
  EXPECT_FALSE(this->state().stereo);
  EXPECT_EQ(differingPixels(plain, this->viewer->view().still()), 0u);

  const Vec3 still = this->state().camera.position;
  this->moveTo(100, 200); // beside the handle
  this->mouse(vtkCommand::LeftButtonPressEvent);
  this->moveTo(130, 200);
  this->mouse(vtkCommand::LeftButtonReleaseEvent);
  EXPECT_NE(this->state().camera.position, still); // the trackball's
  this->moveTo(160, 120);
  this->press("p");
  this->save(""); // without the outline
  EXPECT_FALSE(this->viewer->interactor()->GetDone());
  this->press("jte");
  EXPECT_TRUE(this->viewer->interactor()->GetDone());
  EXPECT_EQ(this->drawAgain(), 2);
}

TEST_F(ViewerTest, TheSunShinesByDateAndPlace)
{
  Scene scene = loadScene("bunny");
  ViewState state = initialState("bunny", scene);
  state.size = { 320, 240 };
  placeSun(state, scene, parseSunTime("2024-06-21T13:14+02:00,48.1,11.6", "here"));
  // At noon by the sun in midsummer: 90 - 48.1 + 23.4 degrees, in the south, which is +z.
  const Vec3 towards = state.lights[0].position;
  EXPECT_NEAR(std::asin(towards[1]) * 180.0 / 3.14159265358979, 65.3, 0.1);
  EXPECT_NEAR(towards[0], 0.0, 0.01);
  EXPECT_GT(towards[2], 0.0);
  this->view(std::move(scene), state, { "raytraced" });
  EXPECT_THAT(this->corner(), HasSubstr("sun 2024-06-21T13:14+02:00, 65.3 degrees high"));
  this->press("...");
  EXPECT_THAT(this->corner(), HasSubstr("T14:44+02:00"));
  EXPECT_LT(this->state().lights[0].position[0], -0.1); // in the west
  this->press("<,");
  EXPECT_THAT(this->corner(), HasSubstr("sun 2024-06-14T14:14+02:00"));
}

/// Slow: every mode on larger scenes, with several lights and with areas.
class ViewerScenes
  : public ViewerTest
  , public testing::WithParamInterface<const char*>
{
};
INSTANTIATE_TEST_SUITE_P(All, ViewerScenes, testing::Values("atrium", "room", "terrain"),
  [](const auto& scene) { return std::string(scene.param); });

TEST_P(ViewerScenes, ShowEveryModeAgainWithoutAScreen)
{
  const bool soft = std::string(GetParam()) == "room";
  this->view(GetParam(),
    soft ? std::vector<std::string>{ "penumbra", "pcss" }
         : std::vector<std::string>{ "silhouette", "pssm" });
  for (const char* keys : { "", " ", " ", "]", "kn", "xvi", "vh " })
  {
    this->save(keys);
  }
  EXPECT_EQ(this->drawAgain(), 7);
}

} // namespace
} // namespace gnomon::tool
