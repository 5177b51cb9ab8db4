#include "CountedOpenGL.h"

#include "vtkGnomonOffScreenWindow.h"
#include "vtkGnomonPropKeys.h"
#include "vtkGnomonShadowPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <gtest/gtest.h>

namespace
{

enum class Props
{
  Alike,
  OfTwoMaterials, ///< in turns, so of two programs
  ReceiveInTurns  ///< every other one shows no shadows
};

struct Drawing
{
  const char* technique = nullptr; ///< null: plain VTK
  bool moves = false;
  Props props = Props::Alike;
};

/// Return the calls of OpenGL in a frame of so many cubes.
unsigned long callsOf(const Drawing& drawing, int cubes)
{
  const auto window = gnomon::makeOffScreenWindow();
  vtkNew<vtkRenderer> renderer;
  window->SetSize(64, 64);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  vtkNew<vtkCubeSource> source;
  for (int i = 0; i < cubes; ++i)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->SetPosition(2.0 * (i % 10), 2.0 * (i / 10), 0.0);
    const bool isOdd = i % 2 == 1;
    if (isOdd && drawing.props == Props::OfTwoMaterials)
    {
      actor->GetProperty()->SetInterpolationToPBR();
    }
    if (isOdd && drawing.props == Props::ReceiveInTurns)
    {
      vtkGnomonPropKeys::SetReceives(actor, false);
    }
    renderer->AddActor(actor);
  }
  vtkNew<vtkLight> sun;
  sun->SetPosition(1.0, 2.0, 3.0);
  renderer->AddLight(sun);
  vtkNew<vtkGnomonShadowPass> pass;
  if (drawing.technique)
  {
    pass->SetTechnique(drawing.technique);
    pass->SetInteractive(
      drawing.moves ? vtkGnomonShadowPass::INTERACTIVE_ON : vtkGnomonShadowPass::INTERACTIVE_OFF);
    renderer->SetPass(pass);
  }
  renderer->ResetCamera();
  unsigned long before = 0;
  for (int frame = 0; frame < 8; ++frame)
  {
    before = gnomonCountOfGlCalls();
    renderer->GetActiveCamera()->Azimuth(drawing.moves ? 0.1 : 0.0);
    window->Render();
  }
  return gnomonCountOfGlCalls() - before;
}

/// Return the calls that a prop adds to a frame.
double callsOfAProp(const Drawing& drawing)
{
  const auto more = static_cast<double>(callsOf(drawing, 90));
  const auto fewer = static_cast<double>(callsOf(drawing, 50));
  return (more - fewer) / 40.0;
}

} // namespace

// A uniform is set only where its value differs from the last prop's, and OpenGL's state is not
// queried. Numbered triangles take one more uniform, the surface's number.
TEST(GlCalls, ofAPropAreFewMoreThanPlainVtks)
{
  struct Technique
  {
    const char* name;
    double mostMore;
  };
  for (const bool moves : { false, true })
  {
    for (const Props props : { Props::Alike, Props::OfTwoMaterials, Props::ReceiveInTurns })
    {
      const double plain = callsOfAProp({ nullptr, moves, props });
      EXPECT_GT(plain, 5.0) << "functions are counted";
      for (const Technique& technique : { Technique{ "nsm", 2.0 }, { "penumbra", 3.0 },
             { "silhouette", 3.0 }, { "raytraced", 3.0 }, { "auto", 3.0 } })
      {
        EXPECT_LE(callsOfAProp({ technique.name, moves, props }) - plain, technique.mostMore)
          << technique.name << (moves ? " moves " : " rests ") << static_cast<int>(props);
      }
    }
  }
}
