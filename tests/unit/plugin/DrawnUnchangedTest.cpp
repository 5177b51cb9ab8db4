// Props that are no surfaces are drawn as by plain VTK.

#include "PassScene.h"

#include "plugin/vtkGnomonPropKeys.h"

#include <vtkAxesActor.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCubeAxesActor.h>
#include <vtkImageActor.h>
#include <vtkImageData.h>
#include <vtkImageProperty.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkLookupTable.h>
#include <vtkOutlineFilter.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkScalarBarActor.h>
#include <vtkSkybox.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextActor3D.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>

using namespace gnomon::test;

namespace
{

/// A prop that VTK draws near the origin, or over the picture.
struct Thing
{
  const char* name;
  vtkSmartPointer<vtkProp> (*make)(vtkRenderer* renderer);
};

std::ostream& operator<<(std::ostream& stream, const Thing& thing)
{
  return stream << thing.name;
}

vtkSmartPointer<vtkActor> makeBall(int representation)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0.0, 0.0, 1.0);
  sphere->SetRadius(1.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetRepresentation(representation);
  actor->GetProperty()->SetPointSize(4.0f);
  return actor;
}

vtkSmartPointer<vtkImageData> makeSpeckledImage()
{
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(8, 8, 1);
  image->SetOrigin(-1.0, -1.0, 0.5);
  image->SetSpacing(0.3, 0.3, 0.3);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < 192; ++i)
  {
    static_cast<unsigned char*>(image->GetScalarPointer())[i] =
      static_cast<unsigned char>(55 + (i * 37) % 200);
  }
  return image;
}

const Thing things[] = {
  { "Points", [](vtkRenderer*) -> vtkSmartPointer<vtkProp> { return makeBall(VTK_POINTS); } },
  { "Wireframe", [](vtkRenderer*) -> vtkSmartPointer<vtkProp> { return makeBall(VTK_WIREFRAME); } },
  { "Lines",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      const auto actor = makeBall(VTK_SURFACE);
      vtkNew<vtkOutlineFilter> outline;
      outline->SetInputConnection(actor->GetMapper()->GetInputConnection(0, 0));
      actor->GetMapper()->SetInputConnection(outline->GetOutputPort());
      actor->GetProperty()->SetLineWidth(3.0f);
      return actor;
    } },
  { "Tubes",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      const auto actor = makeBall(VTK_WIREFRAME);
      actor->GetProperty()->RenderLinesAsTubesOn();
      actor->GetProperty()->SetLineWidth(5.0f);
      return actor;
    } },
  { "RoundPoints",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      const auto actor = makeBall(VTK_POINTS);
      actor->GetProperty()->RenderPointsAsSpheresOn();
      actor->GetProperty()->SetPointSize(8.0f);
      return actor;
    } },
  { "PointSprites",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      const auto actor = makeBall(VTK_SURFACE);
      vtkNew<vtkPointGaussianMapper> mapper;
      mapper->SetInputConnection(actor->GetMapper()->GetInputConnection(0, 0));
      mapper->SetScaleFactor(0.2);
      actor->SetMapper(mapper);
      return actor;
    } },
  { "Text3D",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      const auto text = vtkSmartPointer<vtkTextActor3D>::New();
      text->SetInput("shadow");
      text->GetTextProperty()->SetFontSize(20);
      text->SetScale(0.03);
      text->SetPosition(-1.0, -0.5, 0.5);
      return text;
    } },
  { "BillboardText",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      const auto text = vtkSmartPointer<vtkBillboardTextActor3D>::New();
      text->SetInput("shadow");
      text->GetTextProperty()->SetFontSize(20);
      text->SetPosition(-1.0, 0.0, 0.5);
      return text;
    } },
  { "Text2D",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      const auto text = vtkSmartPointer<vtkTextActor>::New();
      text->SetInput("shadow");
      text->GetTextProperty()->SetFontSize(24);
      text->SetPosition(30.0, 40.0);
      return text;
    } },
  { "ImageActor",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      const auto actor = vtkSmartPointer<vtkImageActor>::New();
      actor->SetInputData(makeSpeckledImage());
      return actor;
    } },
  { "ImageSlice",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      vtkNew<vtkImageSliceMapper> mapper;
      mapper->SetInputData(makeSpeckledImage());
      const auto slice = vtkSmartPointer<vtkImageSlice>::New();
      slice->SetMapper(mapper);
      slice->GetProperty()->SetInterpolationTypeToNearest();
      return slice;
    } },
  { "Skybox",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      vtkNew<vtkTexture> texture;
      texture->SetInputData(makeSpeckledImage());
      const auto skybox = vtkSmartPointer<vtkSkybox>::New();
      skybox->SetTexture(texture);
      skybox->SetProjectionToSphere();
      return skybox;
    } },
  { "CubeAxes",
    [](vtkRenderer* renderer) -> vtkSmartPointer<vtkProp>
    {
      const auto axes = vtkSmartPointer<vtkCubeAxesActor>::New();
      axes->SetBounds(-1.5, 1.5, -1.5, 1.5, 0.1, 2.0);
      axes->SetCamera(renderer->GetActiveCamera());
      return axes;
    } },
  { "Axes",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      const auto axes = vtkSmartPointer<vtkAxesActor>::New();
      axes->SetTotalLength(1.5, 1.5, 1.5);
      return axes;
    } },
  { "ScalarBar",
    [](vtkRenderer*) -> vtkSmartPointer<vtkProp>
    {
      vtkNew<vtkLookupTable> colours;
      colours->SetRange(0.0, 1.0);
      colours->Build();
      const auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
      bar->SetLookupTable(colours);
      bar->SetTitle("shadow");
      return bar;
    } },
};

/// A floor that shows no shadows, below a plate that shades all of it. Props between them must look
/// unchanged.
class DrawnUnchanged
  : public PassTest
  , public testing::WithParamInterface<std::tuple<Thing, Way>>
{
protected:
  DrawnUnchanged()
  {
    vtkActor* floor = this->scene.addFloor(3.0);
    vtkGnomonPropKeys::SetReceives(floor, false);
    vtkActor* plate = this->scene.addFloor(3.0, 4.0);
    vtkGnomonPropKeys::SetReceives(plate, false);
    this->scene.addSun({ 0.1, 0.2, -1.0 });
    this->scene.lookFrom({ 1.0, -7.0, 3.0 }, { 0.0, 0.0, 1.0 });
    this->scene.renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
    this->scene.renderer->SetBackground(0.1, 0.1, 0.3);
    this->scene.choose(std::get<1>(GetParam()));
  }

  /// Return the pixels that differ from plain VTK's picture.
  std::size_t changedPixels()
  {
    this->scene.usePlain();
    const Picture plain = this->scene.render();
    this->scene.useGnomon();
    const Picture shadowed = this->scene.render();
    EXPECT_NE(this->scene.report().route, "none");
    return differingPixels(plain, shadowed);
  }

  PassScene scene{ 120, 90 };
};

std::string nameOfPair(const testing::TestParamInfo<std::tuple<Thing, Way>>& info)
{
  const Way way = std::get<1>(info.param);
  return std::get<0>(info.param).name + nameOf({ way, info.index });
}

INSTANTIATE_TEST_SUITE_P(
  All, DrawnUnchanged, testing::Combine(testing::ValuesIn(things), allWays), nameOfPair);

} // namespace

//------------------------------------------------------------------------------
TEST_P(DrawnUnchanged, inTheShadowToo)
{
  this->scene.usePlain();
  const Picture without = this->scene.render();
  const auto thing = std::get<0>(GetParam()).make(this->scene.renderer);
  this->scene.renderer->AddViewProp(thing);
  EXPECT_GT(differingPixels(without, this->scene.render()), 40u) << "it is not seen";
  EXPECT_EQ(this->changedPixels(), 0u);

  this->scene.renderer->AddActor(makeBall(VTK_SURFACE)); // a surface would change
  EXPECT_GT(this->changedPixels(), 100u);
}
