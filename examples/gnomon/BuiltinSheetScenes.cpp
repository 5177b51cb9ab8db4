#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "MeshBuilder.h"
#include "Vec3.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <functional>

// Scenes of sheets without thickness, and of thin objects.

namespace gnomon::tool
{

namespace
{

/// Add a bowl around an axis, open upwards. It is the part of a sphere below a fifth of the radius
/// above the sphere's centre. That centre lies one radius along the axis.
void addCup(MeshBuilder& mesh, const Axis& axis, double radius)
{
  const Vec3 helper{ { 0.0, 0.0, 1.0 } };
  const Vec3 right = normalized(cross(axis.direction, helper));
  const Vec3 back = cross(right, axis.direction);
  const double rim = std::asin(0.2);
  mesh.addPatch(32, 12,
    [&](double u, double v)
    {
      // The last step closes the circle exactly, and the pole is exactly one point.
      const double along = u == 1.0 ? 0.0 : 2.0 * vtkMath::Pi() * u;
      const double latitude = (1.0 - v) * -0.5 * vtkMath::Pi() + v * rim;
      const double ring = v == 0.0 ? 0.0 : std::cos(latitude);
      const Vec3 outward = std::cos(along) * right - std::sin(along) * back;
      const Vec3 normal = ring * outward + (v == 0.0 ? -1.0 : std::sin(latitude)) * axis.direction;
      return SurfacePoint{ axis.origin + radius * (axis.direction + normal), normal };
    });
}

/// Return an open sheet on a horizontal edge.
SceneModel makePanel(const Vec3& middle, const Vec3& along, double width, double height)
{
  const Vec3 half = (0.5 * width) * along;
  MeshBuilder mesh;
  mesh.addPolygon(
    { middle - half, middle + half, middle + half + height * up, middle - half + height * up });
  return makeModel("panel", mesh.build(), { { 0.12, 0.12, 0.13 } });
}

SceneModel withColor(SceneModel model, const std::string& name, const Vec3& color)
{
  model.name = name;
  model.property->SetColor(color[0], color[1], color[2]);
  return model;
}

/// Return a white texture of texels x texels, with alpha 0 in its holes.
vtkSmartPointer<vtkTexture> makeHoles(
  int texels, const std::function<bool(double u, double v)>& isHole)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(texels, texels, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* texel = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int y = 0; y < texels; ++y)
  {
    for (int x = 0; x < texels; ++x)
    {
      texel = std::fill_n(texel, 3, static_cast<unsigned char>(255));
      *texel++ = isHole((x + 0.5) / texels, (y + 0.5) / texels) ? 0 : 255;
    }
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  return texture;
}

/// Return a sheet of columns x rows cells that repeats a texture `across` and `upward` times.
SceneModel makeTexturedSheet(const std::string& name, int columns, int rows,
  const std::function<Vec3(double u, double v)>& place, vtkSmartPointer<vtkTexture> texture,
  double across, double upward)
{
  MeshBuilder mesh;
  mesh.addSheet(columns, rows, place);
  SceneModel model = makeModel(name, mesh.build(), { { 0.62, 0.5, 0.36 } });
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("TextureCoordinates");
  coordinates->SetNumberOfComponents(2);
  for (int row = 0; row <= rows; ++row)
  {
    for (int column = 0; column <= columns; ++column)
    {
      coordinates->InsertNextTuple2(across * column / columns, upward * row / rows);
    }
  }
  model.surface->GetPointData()->SetTCoords(coordinates);
  model.texture = std::move(texture);
  return model;
}

} // namespace

//------------------------------------------------------------------------------
Scene makeHalfPlaneScene()
{
  constexpr double height = 2.5;
  constexpr double reach = 40.0; // beyond the camera's view of the half plane and its shadow
  Scene scene;
  MeshBuilder half;
  half.addPolygon({ { { -reach, height, reach } }, { { 0.0, height, reach } },
    { { 0.0, height, -reach } }, { { -reach, height, -reach } } });
  scene.models = { makeModel("half plane", half.build(), { { 0.5, 0.62, 0.75 } }),
    makePlane(origin, 2.0 * reach) };
  scene.camera = makeCamera({ { 6.5, 4.2, 5.5 } }, { { 0.6, 0.4, 0.0 } }, 40.0);
  // Along x, the light travels half as far as it falls. Its slight lean along z does not move the
  // shadow's edge.
  scene.lights = { makeSun({ { halfPlaneShadowEdge / height, -1.0, -0.3 } }) };
  return scene;
}

//------------------------------------------------------------------------------
Scene makePanelsScene()
{
  // Apelles' figures 5.5 and 5.7.
  Scene scene;
  scene.models = { withColor(makePlane({ { 0.0, 2.6, 0.0 } }, 2.0), "top", { { 0.85, 0.5, 0.4 } }),
    withColor(makePlane({ { 0.0, 1.3, 0.0 } }, 4.0), "middle", { { 0.5, 0.68, 0.48 } }),
    withColor(makePlane(origin, 11.0), "bottom", { { 0.75, 0.75, 0.72 } }) };
  // Their fronts face along the light, which falls on their backs.
  const Vec3 travel{ { 0.45, -1.0, 0.35 } };
  const Vec3 along = normalized(cross(up, { { travel[0], 0.0, travel[2] } }));
  for (const double offset : { -1.0, 0.0, 1.0 })
  {
    const Vec3 middle = Vec3{ { 2.3, 0.0, 2.3 } } + (2.0 * offset) * along;
    scene.models.push_back(makePanel(middle, along, 1.3, 1.2));
  }
  scene.camera = makeCamera({ { 3.6, 6.2, 9.5 } }, { { 0.5, 0.7, 0.6 } }, 40.0);
  scene.lights = { makeSun(travel) };
  return scene;
}

//------------------------------------------------------------------------------
Scene makeScreensScene()
{
  Scene scene;
  const auto lattice = makeHoles(
    16, [](double u, double v) { return std::abs(u - 0.5) < 0.36 && std::abs(v - 0.5) < 0.36; });
  const auto discs =
    makeHoles(64, [](double u, double v) { return std::hypot(u - 0.5, v - 0.5) < 0.37; });
  scene.models = {
    makeTexturedSheet(
      "lattice", 1, 1,
      [](double u, double v) {
        return Vec3{ { -3.2 + 3.4 * u, 2.4 * v, 0.9 - 0.5 * v } };
      },
      lattice, 8.0, 6.0),
    makeTexturedSheet(
      "bent sheet", 24, 4,
      [](double u, double v)
      {
        const double angle = vtkMath::Pi() * (1.15 - 1.1 * u);
        return Vec3{ { 1.7 + 1.2 * std::cos(angle), 0.15 + 2.3 * v,
          -0.6 + 1.2 * std::sin(angle) } };
      },
      discs, 12.0, 7.0),
    makePlane(origin, 14.0),
  };
  scene.camera = makeCamera({ { 2.6, 5.2, 8.4 } }, { { 0.0, 0.6, 0.6 } }, 42.0);
  scene.lights = { makeSun({ { 0.35, -1.0, 0.8 } }) };
  return scene;
}

//------------------------------------------------------------------------------
Scene makePoleScene()
{
  Scene scene;
  MeshBuilder pole;
  pole.addCone(origin, 18.0, 0.08, 0.08, 24);
  scene.models = { makeModel("pole", pole.build(), { { 0.7, 0.3, 0.28 } }),
    makePlane({ { 14.0, 0.0, -6.0 } }, 80.0) };
  scene.camera = makeCamera({ { 14.0, 20.0, 34.0 } }, { { 11.0, 4.5, -4.0 } }, 40.0);
  scene.lights = { makeSun({ { 1.0, -0.7, -0.4 } }) };
  return scene;
}

//------------------------------------------------------------------------------
Scene makeCupsScene()
{
  Scene scene;
  MeshBuilder standing;
  MeshBuilder hovering;
  for (int i = 0; i < 12; ++i)
  {
    // Four columns and three rows; every other cup is in the air and tilted.
    const double radius = 0.55 + 0.1 * (i % 3);
    const Vec3 foot{ { 2.3 * (i % 4) - 3.6, 0.0, 2.4 * (i / 4) - 2.4 } };
    if ((i + i / 4) % 2 == 0)
    {
      addCup(standing, { foot, up }, radius);
      continue;
    }
    const double turn = 2.4 * i;
    const double lean = 0.35 + 0.15 * i;
    const Vec3 direction{ { std::sin(lean) * std::cos(turn), std::cos(lean),
      std::sin(lean) * std::sin(turn) } };
    addCup(hovering, { foot + (1.3 + 0.08 * i) * up, direction }, radius);
  }
  scene.models = { makeModel("standing cups", standing.build(), { { 0.4, 0.58, 0.7 } }),
    makeModel("hovering cups", hovering.build(), { { 0.82, 0.55, 0.38 } }),
    makePlane(origin, 16.0) };
  scene.camera = makeCamera({ { 1.4, 10.0, 11.5 } }, { { -0.1, 0.4, -0.7 } }, 40.0);
  scene.lights = { makeSun({ { 0.55, -1.0, -0.35 } }) };
  return scene;
}

} // namespace gnomon::tool
