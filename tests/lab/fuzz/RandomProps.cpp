#include "RandomProps.h"

#include "plugin/vtkGnomonPropKeys.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkConeSource.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkLODProp3D.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <limits>

namespace gnomon::fuzz
{
namespace
{

using test::uniform;
using Props = std::vector<vtkSmartPointer<vtkProp3D>>;

vtkSmartPointer<vtkPolyData> surfaceOf(const test::Prop& prop, bool doubles)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(doubles ? VTK_DOUBLE : VTK_FLOAT);
  for (const glm::dvec3& point : prop.mesh.points)
  {
    points->InsertNextPoint(glm::value_ptr(point));
  }
  vtkNew<vtkCellArray> triangles;
  for (const glm::uvec3& triangle : prop.mesh.triangles)
  {
    triangles->InsertNextCell({ triangle.x, triangle.y, triangle.z });
  }
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  if (!prop.textureCoordinates.empty())
  {
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(2);
    for (const glm::vec2& coordinate : prop.textureCoordinates)
    {
      coordinates->InsertNextTuple2(coordinate.x, coordinate.y);
    }
    surface->GetPointData()->SetTCoords(coordinates);
  }
  return surface;
}

vtkSmartPointer<vtkActor> actorOf(vtkPolyData* surface)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

Props drawMeshes(const std::string& kind, Random& random)
{
  Props props;
  for (const test::Prop& prop : test::makeRandomScene(kind, random))
  {
    const vtkSmartPointer<vtkActor> actor = actorOf(surfaceOf(prop, random() % 2 == 0));
    vtkNew<vtkMatrix4x4> matrix;
    matrix->DeepCopy(glm::value_ptr(glm::transpose(prop.worldFromMesh)));
    actor->SetUserMatrix(matrix);
    vtkGnomonPropKeys::SetOneSided(actor, prop.oneSided);
    if (prop.cutout)
    {
      actor->SetTexture(drawHoles(random));
      actor->ForceOpaqueOn();
    }
    props.push_back(actor);
  }
  return props;
}

/// Smooth normals and texture coordinates, too.
vtkSmartPointer<vtkPolyData> drawBall(Random& random)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(uniform(random, 0.05, 1.0));
  sphere->SetThetaResolution(3 + static_cast<int>(random() % 14));
  sphere->SetPhiResolution(3 + static_cast<int>(random() % 10));
  sphere->Update();
  vtkSmartPointer<vtkPolyData> ball = sphere->GetOutput();
  return ball;
}

vtkSmartPointer<vtkPolyData> drawSquare(Random& random)
{
  const double side = uniform(random, 0.2, 1.5);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-side, -side, 0.0);
  plane->SetPoint1(side, -side, 0.0);
  plane->SetPoint2(-side, side, 0.0);
  plane->SetResolution(1 + static_cast<int>(random() % 3), 1);
  plane->Update();
  vtkSmartPointer<vtkPolyData> square = plane->GetOutput();
  return square;
}

vtkSmartPointer<vtkProp3D> placed(vtkSmartPointer<vtkProp3D> prop, Random& random)
{
  prop->SetPosition(
    uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), uniform(random, 0.0, 2.5));
  prop->RotateWXYZ(uniform(random, 0.0, 360.0), uniform(random, -1.0, 1.0), 1.0, 0.3);
  return prop;
}

Props drawSmoothBall(Random& random)
{
  const vtkSmartPointer<vtkActor> actor = actorOf(drawBall(random));
  actor->GetProperty()->SetInterpolation(static_cast<int>(random() % 3));
  return { placed(actor, random) };
}

Props drawGlyphs(Random& random)
{
  vtkNew<vtkPoints> places;
  for (unsigned left = random() % 12; left > 0; --left)
  {
    places->InsertNextPoint(
      uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), uniform(random, 0.0, 2.0));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(places);
  vtkNew<vtkConeSource> cone;
  cone->SetHeight(uniform(random, 0.1, 1.0));
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceConnection(cone->GetOutputPort());
  mapper->SetScaleFactor(uniform(random, -1.0, 1.0));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  return { actor.Get() };
}

Props drawFence(Random& random)
{
  const vtkSmartPointer<vtkActor> actor = actorOf(drawSquare(random));
  actor->SetTexture(drawHoles(random));
  actor->ForceOpaqueOn();
  return { placed(actor, random) };
}

Props drawPane(Random& random)
{
  const vtkSmartPointer<vtkActor> actor = actorOf(drawSquare(random));
  actor->GetProperty()->SetOpacity(uniform(random, 0.0, 1.0));
  if (chance(random, 0.3))
  {
    vtkGnomonPropKeys::SetCasts(actor, true);
  }
  return { placed(actor, random) };
}

Props drawLevels(Random& random)
{
  vtkNew<vtkLODProp3D> levels;
  levels->AutomaticLODSelectionOff();
  for (int level = 0; level < 2; ++level)
  {
    levels->SetSelectedLODID(levels->AddLOD(actorOf(drawBall(random))->GetMapper(), 0.0));
  }
  return { placed(levels, random) };
}

/// Points, a line, and a triangle whose corners are not all finite, or nothing.
Props drawLeftovers(Random& random)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  if (chance(random, 0.7))
  {
    for (int i = 0; i < 3; ++i)
    {
      points->InsertNextPoint(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), 1.0);
    }
    vtkNew<vtkCellArray> all;
    all->InsertNextCell({ 0, 1, 2 });
    data->SetVerts(all);
    data->SetLines(all);
    data->SetPolys(all);
  }
  if (points->GetNumberOfPoints() > 0 && chance(random, 0.3))
  {
    points->SetPoint(1, 0.0, std::numeric_limits<double>::quiet_NaN(), 1.0);
  }
  data->SetPoints(points);
  return { placed(actorOf(data), random) };
}

} // namespace

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> drawSurface(Random& random)
{
  const std::vector<test::Prop> props =
    test::makeRandomScene(pick(test::randomSceneNames(), random), random);
  return surfaceOf(props.back(), random() % 2 == 0);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkTexture> drawHoles(Random& random)
{
  const int side = 1 + static_cast<int>(random() % 8);
  vtkNew<vtkImageData> image;
  image->SetDimensions(side, side, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* values = static_cast<unsigned char*>(image->GetScalarPointer());
  std::generate_n(values, 4 * side * side, [&] { return static_cast<unsigned char>(random()); });
  for (int texel = 0; texel < side * side; ++texel)
  {
    values[4 * texel + 3] = chance(random, 0.4) ? 0 : 255;
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->SetInterpolate(random() % 2 == 0);
  return texture;
}

//------------------------------------------------------------------------------
RandomProps drawProps(Random& random)
{
  static const std::vector<std::pair<std::string, Props (*)(Random&)>> kinds = {
    { "ball", drawSmoothBall }, { "glyphs", drawGlyphs }, { "fence", drawFence },
    { "pane", drawPane }, { "levels", drawLevels }, { "leftovers", drawLeftovers }
  };
  if (chance(random, 0.5))
  {
    const std::string mesh = pick(test::randomSceneNames(), random);
    return { mesh, drawMeshes(mesh, random) };
  }
  const auto& [kind, draw] = pick(kinds, random);
  return { kind, draw(random) };
}

} // namespace gnomon::fuzz
