// Props that are no surfaces are drawn as by plain VTK, in the shadow too.

#include "ChangingProps.h"
#include "PassScene.h"

#include <vtkBillboardTextActor3D.h>
#include <vtkCubeAxesActor.h>
#include <vtkLookupTable.h>
#include <vtkScalarBarActor.h>
#include <vtkSkybox.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

namespace gnomon::test
{
namespace
{

/// A floor that shows no shadows, below a plate that shades all of it. Props between them must look
/// unchanged.
struct DrawnUnchanged : PassTestOf<Way>
{
  DrawnUnchanged()
  {
    for (const double height : { 0.0, 4.0 })
    {
      vtkGnomonPropKeys::SetReceives(this->scene.addFloor(3.0, height), false);
    }
    this->scene.addSun({ 0.1, 0.2, -1.0 });
    this->scene.lookFrom({ 1.0, -7.0, 3.0 }, { 0.0, 0.0, 1.0 });
    this->scene.renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
    this->scene.renderer->SetBackground(0.1, 0.1, 0.3);
    this->scene.choose(GetParam());
    this->without = this->scene.renderPlain();
  }

  /// Return the pixels that differ from plain VTK's picture with a prop, which is seen.
  std::size_t changedPixels(vtkProp* prop)
  {
    this->scene.renderer->AddViewProp(prop);
    this->scene.usePlain();
    this->scene.render(); // image reslicing begins in the second frame
    const Picture plain = this->scene.render();
    EXPECT_GT(differingPixels(this->without, plain), 20u) << "it is not seen";
    this->scene.useGnomon();
    const std::size_t changed = differingPixels(plain, this->scene.render());
    EXPECT_NE(this->scene.report().route, "none");
    this->scene.renderer->RemoveViewProp(prop);
    return changed;
  }

  PassScene scene{ 120, 90 };
  Picture without;
};
INSTANTIATE_TEST_SUITE_P(Ways, DrawnUnchanged, allWays, nameOf);

/// Annotations that lie over the picture or around the scene, and lines and points that VTK lights.
std::vector<vtkSmartPointer<vtkProp>> annotations(vtkRenderer* renderer)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0.0, 0.0, 1.0);
  const auto mapper = mapperOf(sphere);
  const auto tubes = actorOf(mapper);
  tubes->GetProperty()->SetRepresentationToWireframe();
  tubes->GetProperty()->RenderLinesAsTubesOn();
  tubes->GetProperty()->SetLineWidth(5.0f);
  const auto roundPoints = actorOf(mapper);
  roundPoints->GetProperty()->SetRepresentationToPoints();
  roundPoints->GetProperty()->RenderPointsAsSpheresOn();
  roundPoints->GetProperty()->SetPointSize(8.0f);
  vtkNew<vtkBillboardTextActor3D> billboard;
  billboard->SetInput("shadow");
  billboard->GetTextProperty()->SetFontSize(20);
  billboard->SetPosition(-1.0, 0.0, 0.5);
  vtkNew<vtkTextActor> text;
  text->SetInput("shadow");
  text->GetTextProperty()->SetFontSize(24);
  text->SetPosition(30.0, 40.0);
  const auto texture =
    textureOf(makeImage(8, 8, [](int x, int y) { return glm::dvec3(0.1 * x, 0.1 * y, 1.0); }));
  vtkNew<vtkSkybox> skybox;
  skybox->SetTexture(texture);
  skybox->SetProjectionToSphere();
  vtkNew<vtkCubeAxesActor> axes;
  axes->SetBounds(-1.5, 1.5, -1.5, 1.5, 0.1, 2.0);
  axes->SetCamera(renderer->GetActiveCamera());
  vtkNew<vtkLookupTable> colours;
  colours->SetRange(0.0, 1.0);
  colours->Build();
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colours);
  bar->SetTitle("shadow");
  return { tubes.Get(), roundPoints.Get(), billboard.Get(), text.Get(), skybox.Get(), axes.Get(),
    bar.Get() };
}

} // namespace

TEST_P(DrawnUnchanged, inTheShadowToo)
{
  for (const PropKind& kind : changingProps())
  {
    SCOPED_TRACE(kind.name);
    const ChangingProp prop = kind.make(this->scene.renderer);
    const bool isSurface = kind.name == std::string("surface") || kind.name == std::string("fence");
    EXPECT_EQ(this->changedPixels(prop.prop) > 0, isSurface);
  }
  for (const vtkSmartPointer<vtkProp>& prop : annotations(this->scene.renderer))
  {
    SCOPED_TRACE(prop->GetClassName());
    EXPECT_EQ(this->changedPixels(prop), 0u);
  }
}

} // namespace gnomon::test
