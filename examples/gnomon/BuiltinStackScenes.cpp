#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "MeshBuilder.h"
#include "Vec3.h"

#include <vtkImageData.h>
#include <vtkMath.h>

#include <algorithm>
#include <array>
#include <cmath>

// Scenes whose casters lie above each other or extend far along the light, so one depth per texel
// is not enough.

namespace gnomon::tool
{

namespace
{

/// Return an upright letter C, open towards +x: three quarters of a ring with a square section
/// around the z axis.
SceneModel makeLetter(const Vec3& center, double inner, double outer, double thickness)
{
  constexpr int segments = 48;
  const double h = 0.5 * thickness;
  const auto direction = [](double share)
  {
    const double angle = 0.25 * vtkMath::Pi() + 1.5 * vtkMath::Pi() * share;
    return Vec3{ { std::cos(angle), std::sin(angle), 0.0 } };
  };
  const auto place = [&](double share, double radius, double z) {
    return center + radius * direction(share) + Vec3{ { 0.0, 0.0, z } };
  };

  MeshBuilder mesh;
  mesh.addPatch(segments, 1,
    [&](double u, double v) {
      return SurfacePoint{ place(u, outer, v * thickness - h), direction(u) };
    });
  mesh.addPatch(segments, 1,
    [&](double u, double v) {
      return SurfacePoint{ place(u, inner, h - v * thickness), -direction(u) };
    });
  for (const double side : { 1.0, -1.0 })
  {
    mesh.addPatch(segments, 1,
      [&](double u, double v)
      {
        const double radius =
          side > 0.0 ? outer + v * (inner - outer) : inner + v * (outer - inner);
        return SurfacePoint{ place(u, radius, side * h), { { 0.0, 0.0, side } } };
      });
  }
  mesh.addPolygon(
    { place(0.0, inner, h), place(0.0, inner, -h), place(0.0, outer, -h), place(0.0, outer, h) });
  mesh.addPolygon(
    { place(1.0, inner, h), place(1.0, outer, h), place(1.0, outer, -h), place(1.0, inner, -h) });
  return makeModel("letter", mesh.build(), { { 0.45, 0.52, 0.72 } });
}

/// Return the picture of a window: two by two panes between dark bars.
vtkSmartPointer<vtkImageData> makePanes()
{
  constexpr int texels = 40; // of a side
  constexpr int bar = 2;     // half a bar's width
  using Colour = std::array<unsigned char, 3>;
  constexpr Colour dark = { 10, 10, 10 };
  constexpr std::array<Colour, 4> panes = { { // the lower row first
    { 40, 200, 60 }, { 50, 80, 255 }, { 255, 50, 40 }, { 255, 220, 70 } } };
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(texels, texels, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* to = static_cast<unsigned char*>(image->GetScalarPointer());
  const auto isBar = [](int place) { return (place + bar) % (texels / 2) < 2 * bar; };
  for (int y = 0; y < texels; ++y)
  {
    for (int x = 0; x < texels; ++x)
    {
      const int pane = 2 * (2 * y / texels) + 2 * x / texels;
      const Colour& colour = isBar(x) || isBar(y) ? dark : panes[static_cast<std::size_t>(pane)];
      to = std::copy(colour.begin(), colour.end(), to);
    }
  }
  return image;
}

} // namespace

//------------------------------------------------------------------------------
Scene makeStackScene()
{
  // Apelles' figures 3.8 and 5.6.
  Scene scene;
  MeshBuilder cube;
  cube.addBox({ { -0.6, 3.6, -0.6 } }, { { 0.6, 4.8, 0.6 } });
  MeshBuilder sphere;
  sphere.addSphere({ { 0.0, 1.7, 0.0 } }, 1.2, 64, 40);
  scene.models = { makeModel("cube", cube.build(), { { 0.75, 0.4, 0.35 } }),
    makeModel("sphere", sphere.build(), { { 0.8, 0.72, 0.5 } }), makePlane(origin, 12.0) };
  scene.camera = makeCamera({ { 3.4, 5.0, 9.0 } }, { { 0.25, 1.9, 0.0 } }, 40.0);
  scene.lights = { makeSun({ { 0.3, -1.0, -0.3 } }) };
  return scene;
}

//------------------------------------------------------------------------------
Scene makeWindowScene()
{
  Scene scene = underLamp(makeStackScene(), 9.0);
  SceneLight& window = scene.lights.front();
  window.area->width = window.area->height = 3.0;
  window.area->texture = makePanes();
  window.intensity = 2.0; // the panes transmit about half
  return scene;
}

//------------------------------------------------------------------------------
Scene makeLongCubeScene()
{
  // The elongated cube of Curtis' thesis, figure 4.2. Its length is only nearly along the light, as
  // sides parallel to the light are neither lit nor dark.
  Scene scene;
  MeshBuilder cube;
  cube.addBox({ { -0.7, 0.6, -0.7 } }, { { 0.7, 6.0, 0.7 } });
  scene.models = { makeModel("cube", cube.build(), { { 0.5, 0.62, 0.45 } }),
    makePlane(origin, 14.0) };
  scene.camera = makeCamera({ { 4.5, 5.5, 10.5 } }, { { 0.5, 2.4, 0.0 } }, 40.0);
  scene.lights = { makeSun({ { 0.25, -1.0, -0.3 } }) };
  return scene;
}

//------------------------------------------------------------------------------
Scene makeLetterScene()
{
  Scene scene;
  scene.models = { makeLetter({ { 0.0, 2.0, 0.0 } }, 1.2, 2.0, 1.6), makePlane(origin, 16.0) };
  scene.camera = makeCamera({ { 6.0, 4.0, 7.0 } }, { { 0.3, 1.5, -0.2 } }, 40.0);
  scene.lights = { makeSun({ { -0.35, -1.0, -0.3 } }) };
  return scene;
}

} // namespace gnomon::tool
