// Runs a program written for plain VTK with Gnomon's shadows and without a display.
//
// The program is a function `gnomonProgram(int, char**)` that this main is linked to. An object
// factory hands it the renderers, windows and interactors below.
//
//   PROGRAM_OUT=PREFIX [PROGRAM_TECHNIQUE=nsm] program ARGUMENT...
//
// writes PREFIX.messages, PREFIX.lights ("own" or "key") and one PREFIX.N.ppm a window: its last
// picture. The program's own passes are not used; without PROGRAM_TECHNIQUE there is none.
//
// With PROGRAM_FRAMES=N, the camera of the first renderer moves by small steps where the program
// starts its interactor. It moves in runs of N frames without Gnomon and with it, as frames in
// motion. PREFIX.motion gets the median milliseconds of both, and the last choice of `auto`.

#include <vtkGnomonEGLRenderWindow.h>
#include <vtkGnomonLightPlacement.h>
#include <vtkGnomonShadowPass.h>

#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkFileOutputWindow.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderer.h>
#include <vtkPNMWriter.h>
#include <vtkRendererCollection.h>
#include <vtkSmartPointer.h>
#include <vtkVersion.h>
#include <vtkWindowToImageFilter.h>

#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)
VTK_MODULE_INIT(vtkRenderingContextOpenGL2)
VTK_MODULE_INIT(vtkInteractionStyle)

int gnomonProgram(int argc, char* argv[]);

namespace
{

std::string environment(const char* name)
{
  const char* value = std::getenv(name);
  return value ? value : "";
}

bool movesByPass = false;  // the present frames are timed with the pass
bool movesPlainly = false; // the present frames are timed without the pass
bool anyOwnLight = false;
bool anyKeyLight = false;

// True if a light shines from a place other than the camera's.
bool shinesOffAxis(vtkLight* light, vtkCamera* camera)
{
  const double leastDegrees = 5;
  if (!light->GetSwitch() || light->LightTypeIsHeadlight())
  {
    return false;
  }
  double position[3];
  double focalPoint[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focalPoint);
  // A spot light faces its focal point; a directional light has only a direction.
  const double* from = light->GetPositional() ? camera->GetFocalPoint() : focalPoint;
  double toLight[3];
  vtkMath::Subtract(position, from, toLight);
  double toCamera[3];
  vtkMath::Subtract(camera->GetPosition(), camera->GetFocalPoint(), toCamera);
  return vtkMath::DegreesFromRadians(vtkMath::AngleBetweenVectors(toLight, toCamera)) >
    leastDegrees;
}

// A renderer that adds the pass, and a key light if the program has no light of its own.
class Renderer : public vtkOpenGLRenderer
{
public:
  static Renderer* New();
  vtkTypeMacro(Renderer, vtkOpenGLRenderer);

  void DeviceRender() override
  {
    if (!this->IsActiveCameraCreated())
    {
      this->ResetCamera(); // as VTK does before a first frame
    }
    this->Light();
    const std::string technique = environment("PROGRAM_TECHNIQUE");
    if (technique.empty() || movesPlainly)
    {
      // The program's own passes and shadows would hide Gnomon's effect.
      this->SetPass(nullptr);
      this->UseShadowsOff();
    }
    else
    {
      if (!this->Shadows)
      {
        this->Shadows = vtkSmartPointer<vtkGnomonShadowPass>::New();
        this->Shadows->SetTechnique(technique.c_str());
      }
      this->Shadows->SetInteractive(
        movesByPass ? vtkGnomonShadowPass::INTERACTIVE_ON : vtkGnomonShadowPass::INTERACTIVE_AUTO);
      this->SetPass(this->Shadows);
    }
    this->Superclass::DeviceRender();
  }

  std::string GetChoice() { return this->Shadows ? this->Shadows->GetReport().choice : ""; }

private:
  void Light()
  {
    if (!this->Key)
    {
      this->UpdateLightGeometry();
      vtkCollectionSimpleIterator iterator;
      this->Lights->InitTraversal(iterator);
      while (vtkLight* light = this->Lights->GetNextLight(iterator))
      {
        if (shinesOffAxis(light, this->GetActiveCamera()))
        {
          anyOwnLight = true;
          return;
        }
      }
      if (!this->AutomaticLightCreation && this->Lights->GetNumberOfItems() == 0)
      {
        return; // unlit on purpose
      }
      this->Key = vtkSmartPointer<vtkLight>::New();
      this->AddLight(this->Key);
      anyKeyLight = true;
    }
    if (movesByPass || movesPlainly)
    {
      return; // the camera moves, not the light
    }
    double bounds[6];
    this->ComputeVisiblePropBounds(bounds);
    if (vtkMath::AreBoundsInitialized(bounds))
    {
      vtkGnomonLightPlacement::MakeKeyLight(this->Key, this->GetActiveCamera(), bounds);
    }
  }

  vtkSmartPointer<vtkGnomonShadowPass> Shadows;
  vtkSmartPointer<vtkLight> Key;
};
vtkStandardNewMacro(Renderer);

// A window without a display that writes each picture it shows over the one before.
class Window : public vtkGnomonEGLRenderWindow
{
public:
  static Window* New();
  vtkTypeMacro(Window, vtkGnomonEGLRenderWindow);

  void Render() override
  {
    // A nested call, by the window's own interactor, draws nothing.
    const bool nested = this->CheckInRenderStatus();
    this->Superclass::Render();
    if (!nested && !this->Writing && !this->Selecting())
    {
      this->Writing = true;
      this->Write();
      this->Writing = false;
    }
  }

  // Move the camera in runs of frames, in turn without Gnomon and with it. A run's first frames do
  // not count: VTK rebuilds its shaders when a pass is added or removed.
  void Move(int frames)
  {
    const int runs = 4;
    const int firstFrames = 4;
    this->Writing = true;
    auto* renderer = static_cast<Renderer*>(this->Renderers->GetFirstRenderer());
    std::vector<double> milliseconds[2];
    for (int run = 0; run < 2 * runs; ++run)
    {
      const bool withPass = run % 2 != 0;
      movesPlainly = !withPass;
      movesByPass = withPass;
      for (int i = 0; i < firstFrames + frames; ++i)
      {
        renderer->GetActiveCamera()->Azimuth(0.2);
        const double time = this->MillisecondsOfFrame();
        if (i >= firstFrames)
        {
          milliseconds[withPass].push_back(time);
        }
      }
    }
    std::ofstream file(environment("PROGRAM_OUT") + ".motion");
    for (std::vector<double>& times : milliseconds)
    {
      std::sort(times.begin(), times.end());
      file << times[times.size() / 2] << '\t';
    }
    file << renderer->GetChoice() << '\n';
    movesPlainly = movesByPass = this->Writing = false;
  }

private:
  double MillisecondsOfFrame()
  {
    const auto start = std::chrono::steady_clock::now();
    this->Superclass::Render();
    this->WaitForCompletion();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
  }

  Window()
  {
    static int windows = 0;
    this->Number = windows++;
  }

  bool Selecting()
  {
    vtkCollectionSimpleIterator iterator;
    this->Renderers->InitTraversal(iterator);
    while (vtkRenderer* renderer = this->Renderers->GetNextRenderer(iterator))
    {
      if (renderer->GetSelector())
      {
        return true;
      }
    }
    return false;
  }

  void Write()
  {
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(this);
    picture->SetInputBufferTypeToRGB();
    picture->ReadFrontBufferOff();
    picture->ShouldRerenderOff();
    vtkNew<vtkPNMWriter> writer;
    writer->SetInputConnection(picture->GetOutputPort());
    writer->SetFileName(
      (environment("PROGRAM_OUT") + "." + std::to_string(this->Number) + ".ppm").c_str());
    writer->Write();
  }

  int Number = 0;
  bool Writing = false;
};
vtkStandardNewMacro(Window);

// Start() draws the scene and returns, since there is no user.
class Interactor : public vtkGenericRenderWindowInteractor
{
public:
  static Interactor* New();
  vtkTypeMacro(Interactor, vtkGenericRenderWindowInteractor);

  void Start() override
  {
    if (!this->Initialized)
    {
      this->Initialize();
    }
    this->Render();
    if (const std::string frames = environment("PROGRAM_FRAMES"); !frames.empty())
    {
      static_cast<Window*>(this->RenderWindow)->Move(std::stoi(frames));
    }
  }
};
vtkStandardNewMacro(Interactor);

VTK_CREATE_CREATE_FUNCTION(Renderer);
VTK_CREATE_CREATE_FUNCTION(Window);
VTK_CREATE_CREATE_FUNCTION(Interactor);

class Factory : public vtkObjectFactory
{
public:
  static Factory* New();
  vtkTypeMacro(Factory, vtkObjectFactory);

  const char* GetVTKSourceVersion() override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() override { return "Gnomon's shadows in a program for plain VTK"; }

private:
  Factory()
  {
    this->RegisterOverride("vtkRenderer", "Renderer", "", 1, vtkObjectFactoryCreateRenderer);
    this->RegisterOverride("vtkRenderWindow", "Window", "", 1, vtkObjectFactoryCreateWindow);
    this->RegisterOverride(
      "vtkRenderWindowInteractor", "Interactor", "", 1, vtkObjectFactoryCreateInteractor);
  }
};
vtkStandardNewMacro(Factory);

} // namespace

int main(int argc, char* argv[])
{
  const std::string out = environment("PROGRAM_OUT");
  if (out.empty())
  {
    std::cerr << "PROGRAM_OUT is not set: where to write messages and pictures\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkFileOutputWindow> messages;
  messages->SetFileName((out + ".messages").c_str());
  messages->FlushOn();
  vtkOutputWindow::SetInstance(messages);

  for (const char* name : { "vtkRenderer", "vtkRenderWindow", "vtkRenderWindowInteractor" })
  {
    vtkObjectFactory::SetAllEnableFlags(0, name); // VTK's own factories are registered first
  }
  vtkNew<Factory> factory;
  vtkObjectFactory::RegisterFactory(factory);

  // Such a test returns whether it equals its baseline; here there is none.
  gnomonProgram(argc, argv);

  std::ofstream(out + ".lights") << (anyOwnLight ? "own" : anyKeyLight ? "key" : "none") << '\n';
  return EXIT_SUCCESS;
}
