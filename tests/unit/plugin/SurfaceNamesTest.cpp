// Whose surface and which cell a pixel shows, against VTK's picker, which meets cells by its own
// rays.

#include "PassScene.h"

#include <vtkAssembly.h>
#include <vtkCellPicker.h>
#include <vtkDataSetMapper.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkPropCollection.h>
#include <vtkTextActor.h>

#include <set>

namespace gnomon::test
{
namespace
{

/// A polydata with all kinds of cells: a vertex, a line, a polygon without area, polygons of four
/// and five corners, and a strip of four triangles, side by side.
vtkSmartPointer<vtkPolyData> mixedCells()
{
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 8; ++i)
  {
    points.emplace_back(i / 2 - 1.5, i % 2 * 2.0 - 1.0, 0.0);
  }
  points.emplace_back(-0.5, 1.8, 0.0);
  const auto data = meshOf(points, { { 0, 0, 1 }, { 0, 2, 3, 1 }, { 1, 3, 8 } });
  data->SetVerts(cellsOf({ { 0 } }));
  data->SetLines(cellsOf({ { 0, 1 } }));
  data->SetStrips(cellsOf({ { 3, 2, 5, 4, 7, 6 } }));
  return data;
}

/// The names that a frame gives to pixels.
struct Named
{
  vtkNew<vtkImageData> image;

  explicit Named(const PassScene& scene) { scene.pass->GetVisibilityImage(this->image); }
  int prop(vtkIdType pixel) const
  {
    return vtkIntArray::SafeDownCast(this->image->GetPointData()->GetArray("prop"))
      ->GetValue(pixel);
  }
  vtkIdType cell(vtkIdType pixel) const
  {
    return vtkIdTypeArray::SafeDownCast(this->image->GetPointData()->GetArray("cell"))
      ->GetValue(pixel);
  }
};

struct SurfaceNames : PassTest
{
  SurfaceNames()
  {
    vtkNew<vtkTextActor> text; // number 0, no surface
    text->VisibilityOff();
    this->scene.renderer->AddViewProp(text);
    this->scene.add(mixedCells())->SetPosition(-1.0, 0.0, 1.0);

    vtkNew<vtkPlaneSource> plane; // over the right end of the cells
    plane->SetResolution(3, 2);
    vtkNew<vtkDataSetMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    const auto actor = actorOf(mapper);
    actor->SetPosition(0.4, 0.3, 2.0);
    this->scene.renderer->AddActor(actor);

    vtkNew<vtkAssembly> assembly;
    assembly->AddPart(actorOf(mapperOf(plane)));
    assembly->SetPosition(2.0, 0.0, 1.0);
    this->scene.renderer->AddViewProp(assembly);

    this->scene.addSun({ 0.4, 0.3, -1.0 });
    this->scene.lookDown(2.0);
    this->scene.pass->KeepVisibilityOn();
  }

  int numberOf(vtkProp* prop)
  {
    vtkPropCollection* const props = this->scene.renderer->GetViewProps();
    int number = 0;
    while (props->GetItemAsObject(number) != prop)
    {
      ++number;
    }
    return number;
  }

  PassScene scene{ 120, 80 };
};

constexpr int assemblyNumber = 3;

} // namespace

TEST_F(SurfaceNames, areThePickersPropAndCell)
{
  this->scene.render();
  const Named named(this->scene);
  vtkNew<vtkCellPicker> picker;
  picker->SetTolerance(0.0);
  std::set<std::pair<int, vtkIdType>> seen;
  for (vtkIdType pixel = 0; pixel < 120 * 80; pixel += 7)
  {
    const bool isPicked = picker->Pick(static_cast<double>(pixel % 120) + 0.5,
                            static_cast<double>(pixel / 120) + 0.5, 0.0, this->scene.renderer) != 0;
    const int prop = isPicked ? this->numberOf(picker->GetViewProp()) : -1;
    ASSERT_EQ(named.prop(pixel), prop) << pixel;
    const vtkIdType cell = isPicked && prop != assemblyNumber ? picker->GetCellId() : -1;
    ASSERT_EQ(named.cell(pixel), cell) << pixel;
    seen.emplace(prop, cell);
  }
  // Two polygons and a strip; six squares of the plane; the assembly; nothing.
  EXPECT_THAT(seen,
    testing::IsSupersetOf({ std::pair(1, vtkIdType(3)), std::pair(1, vtkIdType(4)),
      std::pair(1, vtkIdType(5)), std::pair(2, vtkIdType(0)), std::pair(2, vtkIdType(5)),
      std::pair(assemblyNumber, vtkIdType(-1)), std::pair(-1, vtkIdType(-1)) }));
}

/// A prop that is not seen changes nothing else, but the others' numbers.
TEST_F(SurfaceNames, followTheListOfProps)
{
  this->scene.renderer->RemoveViewProp(this->scene.renderer->GetViewProps()->GetLastProp());
  for (int frame = 0; frame < 3; ++frame)
  {
    this->scene.render(); // which reuses what the frame before computed
  }
  const vtkIdType pixel = 40 * 120 + 40;
  EXPECT_EQ(Named(this->scene).prop(pixel), 1);
  this->scene.renderer->RemoveViewProp(
    vtkProp::SafeDownCast(this->scene.renderer->GetViewProps()->GetItemAsObject(0)));
  this->scene.render();
  ASSERT_EQ(this->scene.report().visibilityComputed, 0);
  EXPECT_EQ(Named(this->scene).prop(pixel), 0);
}

/// Without a light that casts there are names, too.
TEST_F(SurfaceNames, needNoLight)
{
  this->scene.renderer->RemoveAllLights();
  this->scene.renderer->AutomaticLightCreationOff();
  this->scene.render();
  EXPECT_EQ(Named(this->scene).prop(40 * 120 + 40), 1);
}

} // namespace gnomon::test
