#include "RandomProps.h"

#include "Shapes.h"

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
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

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
  std::vector<std::vector<vtkIdType>> triangles;
  for (const glm::uvec3& triangle : prop.mesh.triangles)
  {
    triangles.push_back({ triangle.x, triangle.y, triangle.z });
  }
  const auto surface = test::meshOf(prop.mesh.points, triangles, doubles ? VTK_DOUBLE : VTK_FLOAT);
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
  return test::actorOf(test::mapperOf(surface));
}

/// Hang a texture with holes on an actor that is drawn as opaque.
void perforate(vtkActor* actor, Random& random)
{
  actor->SetTexture(drawHoles(random));
  actor->ForceOpaqueOn();
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
      perforate(actor, random);
    }
    props.push_back(actor);
  }
  return props;
}

/// Smooth normals and texture coordinates, too.
vtkSmartPointer<vtkPolyData> drawBall(Random& random)
{
  const double radius = uniform(random, 0.05, 1.0);
  const int around = 3 + static_cast<int>(random() % 14);
  return test::outputOf(
    test::ballOf({ 0.0, 0.0, 0.0 }, radius, around, 3 + static_cast<int>(random() % 10)));
}

vtkSmartPointer<vtkPolyData> drawSquare(Random& random)
{
  const auto square = test::squareOf(uniform(random, 0.2, 1.5));
  square->SetResolution(1 + static_cast<int>(random() % 3), 1);
  return test::outputOf(square);
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
  std::vector<glm::dvec3> places(random() % 12);
  std::generate(places.begin(), places.end(),
    [&]
    {
      return glm::dvec3(
        uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), uniform(random, 0.0, 2.0));
    });
  vtkNew<vtkConeSource> cone;
  cone->SetHeight(uniform(random, 0.1, 1.0));
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(test::meshOf(places, {}));
  mapper->SetSourceConnection(cone->GetOutputPort());
  mapper->SetScaleFactor(uniform(random, -1.0, 1.0));
  return { test::actorOf(mapper) };
}

Props drawFence(Random& random)
{
  const vtkSmartPointer<vtkActor> actor = actorOf(drawSquare(random));
  perforate(actor, random);
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

vtkSmartPointer<vtkPolyData> drawSurface(Random& random)
{
  const std::vector<test::Prop> props =
    test::makeRandomScene(pick(test::randomSceneNames(), random), random);
  return surfaceOf(props.back(), random() % 2 == 0);
}

vtkSmartPointer<vtkImageData> drawImage(Random& random, int width, int height, int components)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  std::generate_n(static_cast<unsigned char*>(image->GetScalarPointer()),
    width * height * components, [&] { return static_cast<unsigned char>(random()); });
  return image;
}

vtkSmartPointer<vtkTexture> drawHoles(Random& random)
{
  const int side = 1 + static_cast<int>(random() % 8);
  const auto image = drawImage(random, side, side, 4);
  for (int texel = 0; texel < side * side; ++texel)
  {
    image->SetScalarComponentFromDouble(
      texel % side, texel / side, 0, 3, chance(random, 0.4) ? 0.0 : 255.0);
  }
  const auto texture = test::textureOf(image);
  texture->SetInterpolate(random() % 2 == 0);
  return texture;
}

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
