// The lines of C++ that the pages of docs/guide show, a function for each page.
//
//   guide picture.png

#include <vtkGnomonAreaLight.h>
#include <vtkGnomonFlatteringLights.h>
#include <vtkGnomonLightKeys.h>
#include <vtkGnomonLightPlacement.h>
#include <vtkGnomonLightSamplingPass.h>
#include <vtkGnomonOffScreenWindow.h>
#include <vtkGnomonPropKeys.h>
#include <vtkGnomonShadowPass.h>
#include <vtkGnomonShadowSettings.h>
#include <vtkGnomonSun.h>
#include <vtkGnomonVisibilityFilter.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkCellData.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderer.h>
#include <vtkSSAAPass.h>
#include <vtkSequencePass.h>
#include <vtkShadowMapBakerPass.h>
#include <vtkShadowMapPass.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>
#include <iostream>

namespace
{

vtkSmartPointer<vtkActor> addSurface(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

/// start.md
void addKeyLight(vtkRenderer* renderer)
{
  vtkNew<vtkLight> key;
  vtkNew<vtkLight> fill;
  vtkNew<vtkGnomonFlatteringLights>()->Make(renderer, key, fill);
  renderer->AddLight(key);
  renderer->AddLight(fill);
}

/// lights.md
void addLights(vtkRenderer* renderer)
{
  vtkNew<vtkLight> sun;
  vtkGnomonLightPlacement::SetPitchAndYaw(sun, -40.0, 30.0);
  vtkGnomonLightPlacement::ShineOnBox(sun, renderer->ComputeVisiblePropBounds());
  renderer->AddLight(sun);

  vtkNew<vtkLight> spot;
  spot->PositionalOn();
  spot->SetConeAngle(30.0); // half of the cone; 90 and more: a point light
  spot->SetPosition(2.0, 3.0, 1.0);
  renderer->AddLight(spot);

  vtkNew<vtkLight> bulb;
  bulb->PositionalOn();
  bulb->SetConeAngle(90.0); // VTK's default, 30, is a spot
  bulb->SetPosition(0.0, 2.4, 0.0);
  renderer->AddLight(bulb);

  vtkNew<vtkGnomonAreaLight> lamp;
  lamp->SetPosition(0.0, 0.0, 5.0);
  lamp->SetShapeToRectangle();
  lamp->SetWidth(1.0);
  lamp->SetHeight(0.5);
  renderer->AddLight(lamp);

  vtkNew<vtkLight> fill;
  renderer->AddLight(fill);

  vtkGnomonLightKeys::SetTechnique(sun, "penumbra");
  vtkGnomonLightKeys::SetSetting(sun, "light_radius", "0.53"); // the disc's whole angle, in degrees
  vtkGnomonLightKeys::SetCasts(fill, false);

  sun->SetShadowAttenuation(0.7); // 1: full shadows, 0: none

  const double up[3] = { 0.0, 0.0, 1.0 };
  vtkGnomonLightKeys::SetBox(sun, 2.0, 2.0, 5.0, up); // width, height, depth
}

void addSky(vtkGnomonShadowPass* shadows)
{
  shadows->SetSkyIntensity(0.4);
}

/// which_technique.md
void chooseTechnique(vtkGnomonShadowPass* shadows, vtkLight* light)
{
  shadows->SetTechnique("silhouette");
  vtkGnomonLightKeys::SetTechnique(light, "pcf");
  shadows->GetSettings()->SetLightRadius(0.5);
  shadows->SetSetting("light_radius", "0.5");
}

/// what_casts.md
void chooseProps(vtkProp* glass, vtkProp* ground, vtkProp* label, vtkProp* wall)
{
  vtkGnomonPropKeys::SetCasts(glass, true);
  vtkGnomonPropKeys::SetCasts(ground, false);
  vtkGnomonPropKeys::SetReceives(label, false);
  vtkGnomonPropKeys::SetOneSided(wall, true);
}

/// passes.md
void putAround(vtkRenderer* renderer, vtkGnomonShadowPass* shadows)
{
  vtkNew<vtkSSAAPass> smooth; // around the shadow pass
  smooth->SetDelegatePass(shadows);
  renderer->SetPass(smooth);
}

void putInside(vtkRenderer* renderer, vtkGnomonShadowPass* shadows)
{
  vtkNew<vtkRenderStepsPass> steps; // inside it
  shadows->SetDelegatePass(steps);
  renderer->SetPass(shadows);
}

void shadeFromPoints(vtkRenderer* renderer, vtkRenderPass* shadows)
{
  vtkNew<vtkGnomonLightSamplingPass> sampling;
  sampling->SetDelegatePass(shadows);
  sampling->SetSamples(256);
  renderer->SetPass(sampling);
}

/// from_vtkShadowMapPass.md
void setVtksPass(vtkRenderer* renderer)
{
  vtkNew<vtkShadowMapPass> shadows;
  shadows->GetShadowMapBakerPass()->SetResolution(1024);
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(shadows->GetShadowMapBakerPass());
  passes->AddItem(shadows);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  renderer->SetPass(camera);
}

vtkSmartPointer<vtkGnomonShadowPass> setGnomonsPass(vtkRenderer* renderer)
{
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetMapSize(1024);
  renderer->SetPass(shadows);
  shadows->ObeyUseShadowsOn();
  shadows->ObeyUseShadowsOff();
  return shadows;
}

/// shadow_as_data.md
double hoursOfSun(vtkAlgorithm* facade, vtkAlgorithm* town)
{
  vtkNew<vtkGnomonSun> sun;
  sun->SetPlace(52.52, 13.405); // degrees north and east
  sun->SetDate(2026, 12, 21);
  sun->SetTime(12, 0, 0.0, 1.0); // the zone: 1 hour east of UTC

  vtkNew<vtkGnomonVisibilityFilter> filter;
  filter->SetInputConnection(facade->GetOutputPort());  // receivers
  filter->AddInputConnection(1, town->GetOutputPort()); // casters: call again for more
  filter->AddSunDay(sun, 10.0);                         // every 10 minutes
  filter->SetSamples(16);                               // rays from a cell to each sun
  filter->Update();
  vtkDataArray* hours = filter->GetOutput()->GetCellData()->GetArray("Hours");
  return hours->GetTuple1(0);
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: guide picture.png\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkCubeSource> cube;
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-2, -2, -0.5);
  plane->SetPoint1(2, -2, -0.5);
  plane->SetPoint2(-2, 2, -0.5);
  auto solid = addSurface(renderer, cube);
  auto ground = addSurface(renderer, plane);
  renderer->GetActiveCamera()->SetPosition(0, -6, 4);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->ResetCamera();
  const auto window = gnomon::makeOffScreenWindow();
  window->SetSize(160, 120);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);

  addKeyLight(renderer);
  setVtksPass(renderer); // not rendered: it reports errors when it is released
  auto shadows = setGnomonsPass(renderer);
  window->Render();
  putAround(renderer, shadows);
  window->Render();
  putInside(renderer, shadows);
  window->Render();
  shadows->SetDelegatePass(nullptr);
  shadeFromPoints(renderer, shadows);
  window->Render();
  renderer->SetPass(shadows);

  addLights(renderer);
  addSky(shadows);
  vtkNew<vtkLight> light;
  renderer->AddLight(light);
  chooseTechnique(shadows, light);
  chooseProps(solid, ground, ground, solid);
  window->Render();
  std::cout << shadows->GetReportText() << "\n" << hoursOfSun(plane, cube) << " hours of sun\n";

  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(argv[1]);
  writer->Write();
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
