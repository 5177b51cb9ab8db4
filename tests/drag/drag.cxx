// A window of VTK's own whose scene has shadows; tests/drag/run.py drives it by X events.
//
//   drag STYLE [plain] [timer] [marker] [SETTING=VALUE ...]
//   drag
//
// STYLE is a name in the table below; without one, the program prints the names. `plain` leaves the
// pass out, `timer` renders every 50 ms, `marker` adds draggable axes. Each SETTING is a light's.
//
// The keys F11 and F12 print the camera, the cone's matrix and the number of frames so far. F10
// prints how many pixels of the shown picture differ from those of a new pass. F9 puts everything
// back. X keeps the order of events: all that was sent before a key is done before it.

#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkConeSource.h>
#include <vtkInteractorStyleDrawPolygon.h>
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
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOrientationMarkerWidget.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace
{

template <class Style>
vtkSmartPointer<vtkInteractorStyle> make()
{
  return vtkSmartPointer<Style>::New();
}

/// Every style of VTK 9.1 that reacts to drags in scenes of actors.
const std::map<std::string, vtkSmartPointer<vtkInteractorStyle> (*)()> styles = {
  { "DrawPolygon", make<vtkInteractorStyleDrawPolygon> },
  { "Flight", make<vtkInteractorStyleFlight> },
  { "Image", make<vtkInteractorStyleImage> },
  { "JoystickActor", make<vtkInteractorStyleJoystickActor> },
  { "JoystickCamera", make<vtkInteractorStyleJoystickCamera> },
  { "MultiTouchCamera", make<vtkInteractorStyleMultiTouchCamera> },
  { "RubberBand2D", make<vtkInteractorStyleRubberBand2D> },
  { "RubberBand3D", make<vtkInteractorStyleRubberBand3D> },
  { "RubberBandPick", make<vtkInteractorStyleRubberBandPick> },
  { "RubberBandZoom", make<vtkInteractorStyleRubberBandZoom> },
  { "Switch", make<vtkInteractorStyleSwitch> },
  { "Terrain", make<vtkInteractorStyleTerrain> },
  { "TrackballActor", make<vtkInteractorStyleTrackballActor> },
  { "TrackballCamera", make<vtkInteractorStyleTrackballCamera> },
  { "Unicam", make<vtkInteractorStyleUnicam> },
};

/// Calls a function at an event.
class Call : public vtkCommand
{
public:
  static Call* New() { return new Call; }
  void Execute(vtkObject*, unsigned long, void*) override { this->call(); }

  std::function<void()> call;
};

vtkSmartPointer<Call> observe(
  vtkObject* object, unsigned long event, const std::function<void()>& call)
{
  const auto command = vtkSmartPointer<Call>::New();
  command->call = call;
  object->AddObserver(event, command);
  return command;
}

/// A cone over a plane, under one light.
struct Scene
{
  vtkNew<vtkRenderer> renderer;
  vtkSmartPointer<vtkActor> cone;

  Scene()
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-1, -1, -0.6);
    plane->SetPoint1(1, -1, -0.6);
    plane->SetPoint2(-1, 1, -0.6);
    this->add(plane)->PickableOff();
    this->cone = this->add(vtkNew<vtkConeSource>());
    vtkNew<vtkLight> light;
    light->SetPosition(1, -1, 2);
    light->SetPositional(true);
    this->renderer->AddLight(light);
    this->putBack();
  }

  vtkSmartPointer<vtkActor> add(vtkPolyDataAlgorithm* source)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    const auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    this->renderer->AddActor(actor);
    return actor;
  }

  /// Undo what styles do to the cone and the camera.
  void putBack()
  {
    this->cone->SetPosition(0, 0, 0);
    this->cone->SetOrientation(0, 0, 0);
    this->cone->SetScale(1, 1, 1);
    vtkCamera* const camera = this->renderer->GetActiveCamera();
    camera->SetPosition(0, -3, 2);
    camera->SetFocalPoint(0, 0, 0);
    camera->SetViewUp(0, 0, 1);
    this->renderer->ResetCamera();
  }
};

vtkSmartPointer<vtkGnomonShadowPass> makeShadows(const std::vector<std::string>& settings)
{
  const auto shadows = vtkSmartPointer<vtkGnomonShadowPass>::New();
  for (const std::string& setting : settings)
  {
    const std::size_t end = setting.find('=');
    shadows->SetSetting(setting.substr(0, end).c_str(), setting.substr(end + 1).c_str());
  }
  return shadows;
}

/// The picture that the window shows, without drawing it.
std::vector<unsigned char> shownPicture(vtkRenderWindow* window)
{
  const int* size = window->GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  const int front = 1;
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, front, pixels);
  return { pixels->Begin(), pixels->End() };
}

/// Count the pixels of the shown picture that differ from those of a pass without history.
int countDifferences(vtkRenderer* renderer, vtkGnomonShadowPass* fresh)
{
  vtkRenderWindow* const window = renderer->GetRenderWindow();
  const std::vector<unsigned char> shown = shownPicture(window);
  const vtkSmartPointer<vtkRenderPass> shadows = renderer->GetPass();
  fresh->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_OFF);
  renderer->SetPass(shadows ? fresh : nullptr);
  do
  {
    window->Render();
  } while (fresh->GetProgress() < 1.0);
  renderer->SetPass(shadows);
  const std::vector<unsigned char> expected = shownPicture(window);
  int different = 0;
  for (std::size_t i = 0; i < shown.size(); i += 3)
  {
    different += std::equal(&shown[i], &shown[i] + 3, &expected[i]) ? 0 : 1;
  }
  return different;
}

void print(const char* name, const double* numbers, int count)
{
  std::printf("\"%s\": [", name);
  for (int i = 0; i < count; ++i)
  {
    std::printf(i == 0 ? "%.17g" : ", %.17g", numbers[i]);
  }
  std::printf("], ");
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc == 1)
  {
    for (const auto& [name, style] : styles)
    {
      std::printf("%s\n", name.c_str());
    }
    return 0;
  }
  std::vector<std::string> settings;
  std::set<std::string> words;
  for (int i = 2; i < argc; ++i)
  {
    const std::string word = argv[i];
    if (word.find('=') == std::string::npos)
    {
      words.insert(word);
    }
    else
    {
      settings.push_back(word);
    }
  }

  Scene scene;
  if (words.count("plain") == 0)
  {
    scene.renderer->SetPass(makeShadows(settings));
  }
  vtkNew<vtkRenderWindow> window;
  window->SetSize(160, 120);
  window->SetMultiSamples(0);
  window->AddRenderer(scene.renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  interactor->SetInteractorStyle(styles.at(argv[1])());
  interactor->SetNumberOfFlyFrames(3);
  interactor->Initialize();

  vtkNew<vtkOrientationMarkerWidget> marker;
  if (words.count("marker") != 0)
  {
    vtkNew<vtkAxesActor> axes;
    axes->AxisLabelsOff();
    marker->SetOrientationMarker(axes);
    marker->SetInteractor(interactor);
    marker->SetViewport(0, 0, 0.3, 0.4);
    marker->EnabledOn();
    marker->InteractiveOn();
  }
  if (words.count("timer") != 0)
  {
    observe(interactor, vtkCommand::TimerEvent, [&] { interactor->Render(); });
    interactor->CreateRepeatingTimer(50); // milliseconds
  }

  int frames = 0;
  observe(window, vtkCommand::EndEvent, [&] { ++frames; });
  const auto printState = [&]
  {
    vtkCamera* const camera = scene.renderer->GetActiveCamera();
    std::printf("{\"key\": \"%s\", ", interactor->GetKeySym());
    print("position", camera->GetPosition(), 3);
    print("focal point", camera->GetFocalPoint(), 3);
    print("view up", camera->GetViewUp(), 3);
    print("cone", scene.cone->GetMatrix()->GetData(), 16);
    print("axes", marker->GetViewport(), 4);
    std::printf("\"frames\": %d}\n", frames);
    std::fflush(stdout);
  };
  const auto onKey = [&](const char* name, const std::function<void()>& call)
  {
    return observe(interactor, vtkCommand::KeyReleaseEvent,
      [&interactor, name, call]
      {
        if (std::string(name) == interactor->GetKeySym())
        {
          call();
        }
      });
  };
  // While a style has the focus, events reach passive observers only. They must not render.
  onKey("F11", printState)->PassiveObserverOn();
  onKey("F12", printState)->PassiveObserverOn();
  onKey("F10",
    [&]
    {
      const int different = countDifferences(scene.renderer, makeShadows(settings));
      std::printf("{\"key\": \"F10\", \"different\": %d}\n", different);
      std::fflush(stdout);
    });
  onKey("F9",
    [&]
    {
      scene.putBack();
      interactor->Render();
    });

  window->Render();
  std::puts("{}"); // ready
  std::fflush(stdout);
  interactor->Start();
  return 0;
}
