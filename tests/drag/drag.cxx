// A window of VTK's own whose scene has shadows; tests/drag/run.py drives it by X events.
//
//   drag STYLE [plain] [timer] [marker] [SETTING=VALUE ...]
//   drag
//
// STYLE is a name in the table below; without one, the program prints the names. `plain` leaves the
// pass out, `timer` renders every 50 ms, `marker` adds draggable axes. Each SETTING is a light's.
//
// The key F12 prints the camera, the cone's matrix and the number of frames so far. The key F11
// prints how many pixels of the shown picture differ from those of a new pass. The key F10 puts
// everything back. X keeps the order of events: all that was sent before a key is done before it.

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

vtkSmartPointer<vtkActor> add(vtkRenderer* renderer, vtkPolyDataAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

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
  std::vector<std::string> settings(argv + std::min(argc, 2), argv + argc);
  const auto take = [&](const char* word)
  {
    const auto found = std::find(settings.begin(), settings.end(), word);
    const bool isThere = found != settings.end();
    if (isThere)
    {
      settings.erase(found);
    }
    return isThere;
  };
  const bool isPlain = take("plain");
  const bool hasTimer = take("timer");
  const bool hasMarker = take("marker");
  if (argc == 1)
  {
    for (const auto& [name, style] : styles)
    {
      std::printf("%s\n", name.c_str());
    }
    return 0;
  }

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1, -1, -0.6);
  plane->SetPoint1(1, -1, -0.6);
  plane->SetPoint2(-1, 1, -0.6);
  add(renderer, plane)->PickableOff();
  vtkNew<vtkConeSource> cone;
  vtkSmartPointer<vtkActor> actor = add(renderer, cone);
  vtkNew<vtkLight> light;
  light->SetPosition(1, -1, 2);
  light->SetPositional(true);
  renderer->AddLight(light);
  vtkCamera* const camera = renderer->GetActiveCamera();
  camera->SetPosition(0, -3, 2);
  camera->SetViewUp(0, 0, 1);
  renderer->ResetCamera();
  vtkNew<vtkCamera> firstCamera;
  firstCamera->DeepCopy(camera);

  vtkNew<vtkRenderWindow> window;
  window->SetSize(160, 120);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  interactor->SetInteractorStyle(styles.at(argv[1])());
  interactor->Initialize();
  if (!isPlain)
  {
    renderer->SetPass(makeShadows(settings));
  }

  vtkNew<vtkOrientationMarkerWidget> marker;
  vtkNew<vtkAxesActor> axes;
  if (hasMarker)
  {
    axes->AxisLabelsOff();
    marker->SetOrientationMarker(axes);
    marker->SetInteractor(interactor);
    marker->SetViewport(0, 0, 0.3, 0.4);
    marker->EnabledOn();
    marker->InteractiveOn();
  }

  int frames = 0;
  observe(window, vtkCommand::EndEvent, [&] { ++frames; });
  const auto printState = [&]
  {
    std::printf("{");
    print("position", camera->GetPosition(), 3);
    print("focal point", camera->GetFocalPoint(), 3);
    print("view up", camera->GetViewUp(), 3);
    print("cone", actor->GetMatrix()->GetData(), 16);
    print("axes", marker->GetViewport(), 4);
    std::printf("\"frames\": %d}\n", frames);
    std::fflush(stdout);
  };
  const auto compare = [&]
  {
    const std::vector<unsigned char> shown = shownPicture(window);
    const vtkSmartPointer<vtkRenderPass> pass = renderer->GetPass();
    const vtkSmartPointer<vtkGnomonShadowPass> fresh = makeShadows(settings);
    fresh->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_OFF);
    renderer->SetPass(isPlain ? nullptr : fresh.GetPointer());
    do
    {
      window->Render();
    } while (fresh->GetProgress() < 1.0);
    const std::vector<unsigned char> expected = shownPicture(window);
    renderer->SetPass(pass);
    int different = 0;
    for (std::size_t i = 0; i < shown.size(); i += 3)
    {
      different += std::equal(&shown[i], &shown[i] + 3, &expected[i]) ? 0 : 1;
    }
    std::printf("{\"different\": %d}\n", different);
    std::fflush(stdout);
  };
  const auto reset = [&]
  {
    camera->DeepCopy(firstCamera);
    actor->SetPosition(0, 0, 0);
    actor->SetOrientation(0, 0, 0);
    actor->SetScale(1, 1, 1);
    interactor->Render();
  };
  const auto onKey = [&](const char* key, const std::function<void()>& call)
  {
    return observe(interactor, vtkCommand::KeyReleaseEvent,
      [&interactor, key, call]
      {
        if (std::string(key) == interactor->GetKeySym())
        {
          call();
        }
      });
  };
  // While a style has the focus, events reach passive observers only. They must not render.
  onKey("F12", printState)->PassiveObserverOn();
  onKey("F11", compare);
  onKey("F10", reset);
  if (hasTimer)
  {
    observe(interactor, vtkCommand::TimerEvent, [&] { interactor->Render(); });
    interactor->CreateRepeatingTimer(50); // milliseconds
  }
  window->Render();
  printState();
  interactor->Start();
  return 0;
}
