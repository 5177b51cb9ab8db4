// Parts that the clients in C++ share: a scene, shadows as arguments say, and a line for each
// frame, for drag.py to read. client.py is the same in Python.
#pragma once

#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>

#include <cstdio>
#include <string>

namespace client
{

constexpr int width = 320; ///< of the window, in the screen's upper left corner
constexpr int height = 240;

inline void add(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}

/// Print how much of the picture a renderer's frame shows, where the mouse is, and the camera.
inline void tellFrame(vtkObject* caller, unsigned long, void*, void*)
{
  auto* const renderer = static_cast<vtkRenderer*>(caller);
  auto* const shadows = vtkGnomonShadowPass::SafeDownCast(renderer->GetPass());
  const double* const place = renderer->GetActiveCamera()->GetPosition();
  const double* const up = renderer->GetActiveCamera()->GetViewUp();
  const int* const mouse = renderer->GetRenderWindow()->GetInteractor()->GetEventPosition();
  std::printf("frame %g %d %.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n",
    shadows ? shadows->GetProgress() : 1.0, mouse[0], place[0], place[1], place[2], up[0], up[1],
    up[2]);
  std::fflush(stdout);
}

inline void tellTimer(vtkObject*, unsigned long, void*, void*)
{
  std::puts("timer");
  std::fflush(stdout);
}

/// Fill a renderer with the scene, and tell of its frames and its interactor's timers.
/// @return the renderer's pass; null if no argument is a setting
inline vtkSmartPointer<vtkGnomonShadowPass> fill(
  vtkRenderer* renderer, vtkRenderWindowInteractor* interactor, int argc, char* argv[])
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-2, -2, 0);
  plane->SetPoint1(2, -2, 0);
  plane->SetPoint2(-2, 2, 0);
  add(renderer, plane);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0, 0, 1);
  add(renderer, sphere);
  vtkNew<vtkLight> light;
  light->SetPosition(1, 1, 3);
  light->SetPositional(true);
  light->SetConeAngle(90); // a point light
  renderer->AddLight(light);

  double place[6] = { 0, -6, 4, 0, 0, 1 };
  vtkSmartPointer<vtkGnomonShadowPass> shadows;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    const std::string name = argument.substr(0, argument.find('='));
    const std::string value = argument.substr(argument.find('=') + 1);
    if (name == "camera")
    {
      std::sscanf(value.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &place[0], &place[1], &place[2],
        &place[3], &place[4], &place[5]);
      continue;
    }
    if (!shadows)
    {
      shadows = vtkSmartPointer<vtkGnomonShadowPass>::New();
    }
    shadows->SetSetting(name.c_str(), value.c_str());
  }
  renderer->SetPass(shadows);
  renderer->GetActiveCamera()->SetPosition(place);
  renderer->GetActiveCamera()->SetViewUp(place + 3);
  renderer->ResetCameraClippingRange();

  vtkNew<vtkCallbackCommand> frame;
  frame->SetCallback(tellFrame);
  renderer->AddObserver(vtkCommand::EndEvent, frame);
  vtkNew<vtkCallbackCommand> timer;
  timer->SetCallback(tellTimer);
  interactor->AddObserver(vtkCommand::TimerEvent, timer);
  return shadows;
}

} // namespace client
