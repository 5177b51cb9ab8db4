// Drags by each of VTK's interactor styles, driven by events and by timers that fire as event loops
// fire them. Camera and prop must go where plain VTK takes them, and the picture must finish.

#include "PassScene.h"

#include <vtkCommand.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorEventRecorder.h>
#include <vtkInteractorStyleFlight.h>
#include <vtkInteractorStyleImage.h>
#include <vtkInteractorStyleJoystickActor.h>
#include <vtkInteractorStyleJoystickCamera.h>
#include <vtkInteractorStyleMultiTouchCamera.h>
#include <vtkInteractorStyleRubberBand2D.h>
#include <vtkInteractorStyleRubberBand3D.h>
#include <vtkInteractorStyleRubberBandPick.h>
#include <vtkInteractorStyleRubberBandZoom.h>
#include <vtkInteractorStyleSwitch.h>
#include <vtkInteractorStyleTerrain.h>
#include <vtkInteractorStyleTrackballActor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkInteractorStyleUnicam.h>
#include <vtkMatrix4x4.h>
#include <vtkWeakPointer.h>

#include <chrono>
#include <iterator>
#include <thread>

namespace gnomon::test
{
namespace
{

/// An interactor's events and the timers of an event loop.
enum class Loop
{
  X,   ///< each timer fires under its number; a one-shot once
  Wx,  ///< each timer fires after 10 ms, under the number of the last one that was started
  PyQt ///< one timer, which fires every 10 ms under that number until a timer is destroyed
};

struct Style
{
  const char* name;
  vtkInteractorObserver* (*make)();
  bool dependsOnTime = false; ///< true if the time between events matters
};
template <typename OfVtk>
vtkInteractorObserver* make()
{
  return OfVtk::New();
}
const Style styles[] = { { "TrackballCamera", make<vtkInteractorStyleTrackballCamera> },
  { "TrackballActor", make<vtkInteractorStyleTrackballActor> },
  { "JoystickCamera", make<vtkInteractorStyleJoystickCamera>, true },
  { "JoystickActor", make<vtkInteractorStyleJoystickActor>, true },
  { "Switch", make<vtkInteractorStyleSwitch>, true },
  { "Terrain", make<vtkInteractorStyleTerrain> },
  { "Flight", make<vtkInteractorStyleFlight>, true },
  { "Unicam", make<vtkInteractorStyleUnicam>, true }, { "Image", make<vtkInteractorStyleImage> },
  { "MultiTouchCamera", make<vtkInteractorStyleMultiTouchCamera> },
  { "RubberBand2D", make<vtkInteractorStyleRubberBand2D> },
  { "RubberBand3D", make<vtkInteractorStyleRubberBand3D> },
  { "RubberBandPick", make<vtkInteractorStyleRubberBandPick> },
  { "RubberBandZoom", make<vtkInteractorStyleRubberBandZoom> } };

struct Button
{
  const char* name;
  unsigned long press;
  unsigned long release;
};
const Button buttons[] = { { "Left", vtkCommand::LeftButtonPressEvent,
                             vtkCommand::LeftButtonReleaseEvent },
  { "Middle", vtkCommand::MiddleButtonPressEvent, vtkCommand::MiddleButtonReleaseEvent },
  { "Right", vtkCommand::RightButtonPressEvent, vtkCommand::RightButtonReleaseEvent } };

/// Shadows whose pictures take several frames, or whose moving pictures are approximate.
struct Shadows
{
  const char* name;
  const char* settings;
};
const Shadows allShadows[] = { { "Auto", "auto" }, { "Area", "auto light_radius=2" },
  { "Silhouette", "silhouette" }, { "MovingSamples", "penumbra light_radius=2 moving_samples=4" },
  { "Progressive", "sampled light_radius=2 progressive=4" } };

/// A box over a floor in a window with an interactor, and the timers of its event loop.
class DrivenScene : public BoxScene
{
public:
  DrivenScene(Loop loop, const Style& style)
    : BoxScene(80, 60)
    , loop_(loop)
  {
    this->set("edge_samples", "auto");
    this->choose("nsm"); // now that setting is no error
    this->window->SetOffScreenRendering(0);
    this->interactor->SetRenderWindow(this->window);
    this->style.TakeReference(style.make());
    this->interactor->SetInteractorStyle(this->style);
    onEvent(this->interactor, vtkCommand::CreateTimerEvent,
      [this](void* id)
      {
        const bool repeats =
          this->interactor->GetTimerEventType() == vtkRenderWindowInteractor::RepeatingTimer;
        const double duration =
          this->loop_ == Loop::X ? this->interactor->GetTimerEventDuration() : 10.0;
        this->loop_ == Loop::PyQt ? this->timers_.clear() : void();
        this->timers_[*static_cast<int*>(id)] = { now() + duration, duration,
          repeats && this->loop_ == Loop::X };
      });
    onEvent(this->interactor, vtkCommand::DestroyTimerEvent,
      [this](void* data)
      {
        const int id = *static_cast<int*>(data);
        if (this->loop_ == Loop::X)
        {
          EXPECT_NE(id, this->firing_) << "destroyed inside its own event, as X of 9.1 cannot bear";
          this->timers_.erase(id);
        }
        this->loop_ == Loop::PyQt ? this->timers_.clear() : void();
      });
    this->interactor->Initialize();
  }
  ~DrivenScene() { this->window->SetInteractor(nullptr); }

  /// Fire the timers that have expired.
  void fire()
  {
    for (const auto& [id, timer] : std::map(this->timers_))
    {
      if (timer.expires > now() || this->timers_.count(id) == 0)
      {
        continue;
      }
      if (this->loop_ == Loop::X)
      {
        int number = this->firing_ = id;
        this->interactor->InvokeEvent(vtkCommand::TimerEvent, &number);
        this->firing_ = 0;
        timer.repeats ? void(this->timers_[id].expires = now() + timer.duration)
                      : void(this->timers_.erase(id));
        continue;
      }
      this->loop_ == Loop::PyQt ? void(this->timers_[id].expires = now() + timer.duration)
                                : void(this->timers_.erase(id));
      this->interactor->TimerEvent();
    }
  }
  bool hasTimers() const { return !this->timers_.empty(); }

  void send(unsigned long event, int x, int y)
  {
    this->interactor->SetEventInformation(x, y);
    this->interactor->InvokeEvent(event);
  }
  /// Return the camera, and where the props are.
  std::vector<double> place() const
  {
    vtkCamera* const camera = this->renderer->GetActiveCamera();
    std::vector<double> place(camera->GetPosition(), camera->GetPosition() + 3);
    place.insert(place.end(), camera->GetFocalPoint(), camera->GetFocalPoint() + 3);
    place.insert(place.end(), camera->GetViewUp(), camera->GetViewUp() + 3);
    place.push_back(camera->GetParallelScale());
    place.push_back(camera->GetViewAngle());
    for (vtkActor* const prop : { this->floor(), this->renderer->GetActors()->GetLastActor() })
    {
      const double* const matrix = prop->GetMatrix()->GetData();
      place.insert(place.end(), matrix, matrix + 16);
    }
    return place;
  }

  vtkNew<vtkGenericRenderWindowInteractor> interactor;
  vtkSmartPointer<vtkInteractorObserver> style;

private:
  struct Timer
  {
    double expires;
    double duration;
    bool repeats;
  };

  static double now()
  {
    return std::chrono::duration<double, std::milli>(
      std::chrono::steady_clock::now().time_since_epoch())
      .count();
  }

  Loop loop_;
  std::map<int, Timer> timers_; ///< by number
  int firing_ = 0;
};

/// Run the event loop for a while.
void wait(DrivenScene& scene, double milliseconds)
{
  using clock = std::chrono::steady_clock;
  const auto end = clock::now() + std::chrono::duration<double, std::milli>(milliseconds);
  while (clock::now() < end)
  {
    scene.fire();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// Run the event loop until no timer waits, for 3 s at most.
void waitForTimers(DrivenScene& scene)
{
  for (int rounds = 0; scene.hasTimers() && rounds < 300; ++rounds)
  {
    wait(scene, 10.0);
  }
  EXPECT_FALSE(scene.hasTimers()) << "timers go on";
}

/// Return the window's picture as a new pass with the same settings draws it.
Picture fresh(DrivenScene& scene, const Shadows& shadows)
{
  vtkNew<vtkGnomonShadowPass> pass;
  choose(pass, shadows.settings);
  pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_OFF);
  scene.renderer->SetPass(pass);
  Picture picture = scene.render();
  while (pass->GetProgress() < 1.0)
  {
    picture = scene.render();
  }
  scene.useGnomon();
  return picture;
}

using Drag = PassTestOf<std::tuple<Style, Button, Shadows, Loop>>;

TEST_P(Drag, goesWherePlainVtkGoesAndFinishes)
{
  const auto& [style, button, shadows, loop] = GetParam();
  DrivenScene scene(loop, style);
  scene.choose(shadows.settings);
  DrivenScene plain(loop, style);
  plain.usePlain();
  for (DrivenScene* const each : { &scene, &plain })
  {
    each->render();
  }
  const auto both = [&](unsigned long event, int x, int y)
  {
    scene.send(event, x, y);
    plain.send(event, x, y);
    if (!style.dependsOnTime)
    {
      EXPECT_EQ(scene.place(), plain.place()) << vtkCommand::GetStringFromEventId(event);
    }
  };
  for (int drag = 0; drag < 3; ++drag)
  {
    both(vtkCommand::MouseMoveEvent, 40, 30);
    both(button.press, 40, 30);
    for (int step = 1; step <= 3; ++step)
    {
      wait(scene, 4.0);
      both(vtkCommand::MouseMoveEvent, 40 + 3 * step, 30 + 2 * step);
    }
    if (drag == 0)
    {
      const std::vector<double> before[] = { scene.place(), plain.place() };
      wait(scene, 600.0);
      wait(plain, 100.0);
      EXPECT_EQ(scene.place() != before[0], plain.place() != before[1]) << "while held";
    }
    both(button.release, 49, 36);
  }
  waitForTimers(scene);
  EXPECT_EQ(scene.pass->GetProgress(), 1.0);
  const Picture shown = readPicture(scene.window);
  EXPECT_TRUE(shown == fresh(scene, shadows));
}

std::string nameOf(const testing::TestParamInfo<Drag::ParamType>& of)
{
  const char* const loops[] = { "X", "Wx", "PyQt" };
  const auto& [style, button, shadows, loop] = of.param;
  return std::string(style.name) + button.name + shadows.name + loops[static_cast<int>(loop)];
}
/// A scene dragged by the trackball, whose timers fire as X's.
struct PictureTimer
  : PassTest
  , DrivenScene
{
  PictureTimer()
    : DrivenScene(Loop::X, styles[0])
  {
    this->pass->SetTechnique("auto");
    this->useGnomon();
    this->render();
  }
  /// Draw a frame of a moving picture, as a program that moves the camera by itself.
  void move()
  {
    this->window->SetDesiredUpdateRate(this->interactor->GetDesiredUpdateRate());
    this->renderer->GetActiveCamera()->Azimuth(1.0);
    this->render();
    this->window->SetDesiredUpdateRate(this->interactor->GetStillUpdateRate());
  }
  std::string technique() const { return this->report().lights.at(0).technique; }
};

/// The first picture at rest comes at once, with one sample a pixel; the next has smooth edges.
TEST_F(PictureTimer, edgesAreSmoothInTheSecondPictureAtRest)
{
  for (const std::string technique : { "auto", "raytraced" })
  {
    this->pass->SetTechnique(technique.c_str());
    this->render();
    std::vector<double> progress;
    onEvent(this->renderer, vtkCommand::EndEvent,
      [&](void*) { progress.push_back(this->pass->GetProgress()); });
    this->move();
    EXPECT_EQ(progress, std::vector<double>{ 1.0 }) << "in motion";
    const Picture hard = readPicture(this->window);
    waitForTimers(*this);
    // `raytraced` has traced the resting picture's visibility already.
    EXPECT_EQ(progress[1], technique == "auto" ? 1.0 / 16.0 : 1.0);
    EXPECT_EQ(progress.back(), 1.0);
    EXPECT_GT(differingPixels(readPicture(this->window), hard, 8), 5u) << technique;
    EXPECT_TRUE(readPicture(this->window) == fresh(*this, { "", technique.c_str() }));
    this->renderer->RemoveObservers(vtkCommand::EndEvent);
  }
}

TEST_F(PictureTimer, thePassMayGoInTheFrameThatTheTimerDraws)
{
  this->move();
  onEvent(
    this->renderer, vtkCommand::EndEvent, [this](void*) { this->renderer->SetPass(nullptr); });
  wait(*this, 600.0);
  EXPECT_EQ(this->renderer->GetPass(), nullptr);
}

TEST_F(PictureTimer, thePassMayGoWhileATimerWaits)
{
  vtkNew<vtkGnomonShadowPass> other;
  this->renderer->SetPass(other);
  this->move();
  EXPECT_TRUE(this->hasTimers());
  this->renderer->SetPass(nullptr);
  const vtkWeakPointer<vtkGnomonShadowPass> gone = other;
  other.Reset();
  this->render(); // until here VTK's mappers hold the pass
  EXPECT_EQ(gone, nullptr);
  EXPECT_FALSE(this->hasTimers());
}

TEST_F(PictureTimer, offAndOnStartNone)
{
  for (const int interactive :
    { vtkGnomonShadowPass::INTERACTIVE_OFF, vtkGnomonShadowPass::INTERACTIVE_ON })
  {
    this->pass->SetInteractive(interactive);
    this->move();
    EXPECT_FALSE(this->hasTimers());
  }
}

TEST_F(PictureTimer, replayedDragsFinish)
{
  this->interactor->SetRecognizeGestures(false);
  vtkNew<vtkInteractorEventRecorder> recorder;
  recorder->SetInteractor(this->interactor);
  recorder->ReadFromInputStringOn();
  recorder->SetInputString("# StreamVersion 1.1\n"
                           "LeftButtonPressEvent 40 30 0 0 0 0 0\n"
                           "MouseMoveEvent 45 32 0 0 0 0 0\n"
                           "TimerEvent 45 32 0 0 0 0 0\n"
                           "MouseMoveEvent 49 36 0 0 0 0 0\n"
                           "LeftButtonReleaseEvent 49 36 0 0 0 0 0\n");
  recorder->Play();
  waitForTimers(*this);
  EXPECT_EQ(this->technique(), "silhouette");
}

/// Counts the events that ask for the next picture.
struct Unfinished
{
  explicit Unfinished(vtkGnomonShadowPass* pass)
  {
    onEvent(pass, vtkGnomonShadowPass::PictureUnfinishedEvent,
      [this](void* data)
      {
        ++this->count;
        this->milliseconds = *static_cast<int*>(data);
      });
  }
  int count = 0;
  int milliseconds = 0;
};

TEST_F(PictureTimer, asksByAnEventInAnotherThreadThanThePasss)
{
  vtkSmartPointer<vtkGnomonShadowPass> other;
  std::thread([&] { other = vtkSmartPointer<vtkGnomonShadowPass>::New(); }).join();
  Unfinished unfinished(other);
  this->renderer->SetPass(other);
  this->render();
  EXPECT_EQ(unfinished.count, 0);
  this->move();
  EXPECT_EQ(unfinished.count, 1);
  EXPECT_GT(unfinished.milliseconds, 300);
  EXPECT_LE(unfinished.milliseconds, 500);
  EXPECT_FALSE(this->hasTimers());
  this->renderer->SetPass(nullptr);
}

TEST_F(PictureTimer, asksByAnEventWithoutAnInteractor)
{
  Unfinished unfinished(this->pass);
  this->window->SetInteractor(nullptr);
  this->render();
  EXPECT_EQ(unfinished.count, 0);
  this->pass->SetSetting("technique", "penumbra");
  this->pass->SetSetting("light_radius", "2");
  this->pass->SetSetting("moving_samples", "16");
  this->render();
  EXPECT_EQ(unfinished.count, 1);
  this->render();
  EXPECT_EQ(unfinished.count, 1) << "finished";
}

INSTANTIATE_TEST_SUITE_P(Styles, Drag,
  testing::Combine(testing::ValuesIn(styles), testing::ValuesIn(buttons),
    testing::Values(allShadows[0]), testing::Values(Loop::X)),
  nameOf);
INSTANTIATE_TEST_SUITE_P(Loops, Drag,
  testing::Combine(testing::Values(styles[0]), testing::Values(buttons[0]),
    testing::ValuesIn(&allShadows[1], std::end(allShadows)),
    testing::Values(Loop::X, Loop::Wx, Loop::PyQt)),
  nameOf);

} // namespace
TEST_F(PictureTimer, aProgramsOwnTimerMayRemoveThePass)
{
  onEvent(
    this->interactor, vtkCommand::TimerEvent, [this](void*) { this->renderer->SetPass(nullptr); });
  this->interactor->CreateOneShotTimer(5);
  this->move();
  wait(*this, 600.0);
  EXPECT_FALSE(this->hasTimers());
}

TEST_F(PictureTimer, goesOnBesideARepeatingTimerThatRenders)
{
  onEvent(this->interactor, vtkCommand::TimerEvent, [this](void*) { this->interactor->Render(); });
  this->interactor->CreateRepeatingTimer(20);
  this->move();
  wait(*this, 600.0);
  EXPECT_EQ(this->technique(), "silhouette");
}

} // namespace gnomon::test
