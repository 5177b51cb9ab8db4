#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "MeshBuilder.h"
#include "Vec3.h"

#include <vtkMath.h>

#include <cmath>

namespace gnomon::tool
{

namespace
{

const Vec3 blue{ { 0.35, 0.5, 0.7 } };
const Vec3 green{ { 0.45, 0.65, 0.4 } };
const Vec3 red{ { 0.75, 0.4, 0.35 } };
const Vec3 ochre{ { 0.8, 0.65, 0.35 } };

SceneModel makePyramid(const Vec3& base, double side, double height)
{
  const double h = 0.5 * side;
  const Vec3 a = base + Vec3{ { -h, 0.0, h } };
  const Vec3 b = base + Vec3{ { h, 0.0, h } };
  const Vec3 c = base + Vec3{ { h, 0.0, -h } };
  const Vec3 d = base + Vec3{ { -h, 0.0, -h } };
  const Vec3 top = base + Vec3{ { 0.0, height, 0.0 } };
  MeshBuilder mesh;
  mesh.addPolygon({ a, b, top });
  mesh.addPolygon({ b, c, top });
  mesh.addPolygon({ c, d, top });
  mesh.addPolygon({ d, a, top });
  mesh.addPolygon({ d, c, b, a });
  return makeModel("pyramid", mesh.build(), ochre);
}

/// Return a torus around a vertical axis.
SceneModel makeTorus(const Vec3& center, double ringRadius, double tubeRadius)
{
  MeshBuilder mesh;
  mesh.addPatch(48, 32,
    [&](double u, double v)
    {
      // The last step closes each circle exactly.
      const double along = u == 1.0 ? 0.0 : 2.0 * vtkMath::Pi() * u;
      const double around = v == 1.0 ? 0.0 : 2.0 * vtkMath::Pi() * v;
      const Vec3 outward{ { std::cos(along), 0.0, -std::sin(along) } };
      const Vec3 normal = std::cos(around) * outward + Vec3{ { 0.0, std::sin(around), 0.0 } };
      return SurfacePoint{ center + ringRadius * outward + tubeRadius * normal, normal };
    });
  return makeModel("torus", mesh.build(), red);
}

/// Add a board on four legs, between two corners.
void addTable(
  MeshBuilder& mesh, const Vec3& low, const Vec3& high, double legWidth, double boardHeight)
{
  const double board = high[1] - boardHeight;
  mesh.addBox({ { low[0], board, low[2] } }, high);
  for (const double x : { low[0], high[0] - legWidth })
  {
    for (const double z : { low[2], high[2] - legWidth })
    {
      mesh.addBox({ { x, low[1], z } }, { { x + legWidth, board, z + legWidth } });
    }
  }
}

/// Return six walls that face inwards.
vtkSmartPointer<vtkPolyData> makeHall(const Vec3& low, const Vec3& high)
{
  const auto corner = [&](bool x, bool y, bool z) {
    return Vec3{ { x ? high[0] : low[0], y ? high[1] : low[1], z ? high[2] : low[2] } };
  };
  MeshBuilder mesh;
  for (const bool end : { false, true })
  {
    // Corners are counter-clockwise seen along the axis, for the lower wall's front; reversed for
    // the upper wall's.
    const auto add = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
      end ? mesh.addPolygon({ d, c, b, a }) : mesh.addPolygon({ a, b, c, d });
    };
    add(corner(end, false, false), corner(end, true, false), corner(end, true, true),
      corner(end, false, true));
    add(corner(false, end, false), corner(false, end, true), corner(true, end, true),
      corner(true, end, false));
    add(corner(false, false, end), corner(true, false, end), corner(true, true, end),
      corner(false, true, end));
  }
  return mesh.build();
}

} // namespace

//------------------------------------------------------------------------------
Scene makeCubeScene()
{
  Scene scene;
  MeshBuilder cube;
  cube.addBox({ { -1.0, 0.0, -1.0 } }, { { 1.0, 2.0, 1.0 } });
  scene.models = { makeModel("cube", cube.build(), blue), makePlane(origin, 10.0) };
  scene.camera = makeCamera({ { 2.5, 5.5, 7.0 } }, { { 0.7, 0.6, -0.3 } }, 40.0);
  scene.lights = { makeSun({ { 0.7, -1.0, -0.45 } }) };
  return scene;
}

//------------------------------------------------------------------------------
const std::vector<SceneView>& primitivesViews()
{
  // Cameras of the thesis' section 4.1, named as the garden's. The view across the light has no
  // suffix.
  static const std::vector<SceneView> views = {
    { "primitives", "torus, cylinder, pyramid and sphere on a plane, 4,944 triangles",
      { { 35.0, 50.0, -43.0 } }, { { -1.0, -1.2, 1.0 } } },
    { "primitives-with", "the primitives, seen along the light", { { -28.0, 38.0, -40.0 } },
      { { 0.4, -0.7, 0.6 } } },
    { "primitives-against", "the primitives, seen against the light", { { 31.0, 54.0, 38.0 } },
      { { -0.4, -0.7, -0.5 } } },
  };
  return views;
}

//------------------------------------------------------------------------------
Scene makePrimitivesScene(const SceneView& view)
{
  Scene scene;
  MeshBuilder cylinder;
  cylinder.addCone({ { -11.0, 0.0, 6.0 } }, 12.0, 3.0, 3.0, 32);
  MeshBuilder sphere;
  sphere.addSphere({ { 8.0, 5.0, -9.0 } }, 5.0, 28, 32);
  scene.models = { makePlane(origin, 90.0), makePyramid({ { 10.0, 0.0, 8.0 } }, 9.0, 9.0),
    makeModel("cylinder", cylinder.build(), green), makeTorus({ { -7.0, 2.0, -10.0 } }, 6.0, 2.0),
    makeModel("sphere", sphere.build(), blue) };
  scene.camera = makeCamera(view.position, view.position + 41.0 * view.direction, 60.0);
  scene.lights = { makeSun({ { 0.528542, -0.376004, 0.761095 } }) };
  return scene;
}

//------------------------------------------------------------------------------
Scene makePostsScene()
{
  Scene scene;

  // Posts of 2 cm to 12 cm width, in two rows.
  MeshBuilder posts;
  for (int i = 0; i < 6; ++i)
  {
    const double width = 0.02 * (i + 1);
    const double x = -5.0 + 2.0 * i;
    posts.addCone({ { x, 0.0, 1.5 } }, 2.5, 0.5 * width, 0.5 * width, 12);
    posts.addBox({ { x - 0.5 * width, 0.0, 3.0 } }, { { x + 0.5 * width, 2.0, 3.0 + width } });
  }

  // The fence: thick posts, three rails, and pickets 2 cm thin.
  MeshBuilder fence;
  for (int i = 0; i <= 4; ++i)
  {
    const double x = -6.0 + 3.0 * i;
    fence.addBox({ { x - 0.06, 0.0, -2.06 } }, { { x + 0.06, 1.6, -1.94 } });
  }
  for (const double y : { 0.3, 0.8, 1.3 })
  {
    fence.addBox({ { -6.3, y, -1.94 } }, { { 6.3, y + 0.06, -1.9 } });
  }
  for (int i = 0; i <= 48; ++i)
  {
    const double x = -6.0 + 0.25 * i;
    fence.addBox({ { x - 0.03, 0.1, -1.9 } }, { { x + 0.03, 1.5, -1.88 } });
  }

  scene.models = { makeModel("posts", posts.build(), red), makeModel("fence", fence.build(), ochre),
    makePlane(origin, 24.0) };
  scene.camera = makeCamera({ { 2.0, 7.5, 12.0 } }, { { 0.2, 0.0, 0.0 } }, 45.0);
  scene.lights = { makeSun({ { -0.7, -0.75, -0.4 } }) };
  return scene;
}

//------------------------------------------------------------------------------
Scene makePlatesScene()
{
  Scene scene;
  MeshBuilder plates;

  // A pile of touching plates.
  double y = 0.0;
  for (int i = 0; i < 5; ++i)
  {
    const double h = 1.8 - 0.25 * i;
    plates.addBox({ { -3.0 - h, y, -h } }, { { -3.0 + h, y + 0.1, h } });
    y += 0.1;
  }

  // A pile whose gaps grow tenfold from plate to plate; the last plate lies on a post.
  y = 0.0;
  for (const double gap : { 0.0, 0.001, 0.01, 0.1, 1.0 })
  {
    y += gap;
    plates.addBox({ { 1.4 + gap, y, -1.5 } }, { { 4.4 + gap, y + 0.05, 1.5 } });
    y += 0.05;
  }
  plates.addBox({ { 3.6, y - 1.05, -0.05 } }, { { 3.7, y - 0.05, 0.05 } });

  // Leaning plates: one edge on the plane, the other on a bar.
  plates.addBox({ { -1.5, 0.0, 3.0 } }, { { 1.5, 0.4, 3.2 } });
  plates.addPolygon({ { { -1.4, 0.0, 4.6 } }, { { 1.4, 0.0, 4.6 } }, { { 1.4, 0.4, 3.2 } },
    { { -1.4, 0.4, 3.2 } } });

  scene.models = { makeModel("plates", plates.build(), green), makePlane(origin, 18.0) };
  scene.camera = makeCamera({ { 3.0, 8.0, 11.5 } }, { { 0.6, 0.3, 0.6 } }, 45.0);
  scene.lights = { makeSun({ { 0.6, -0.9, -0.5 } }) };
  return scene;
}

//------------------------------------------------------------------------------
Scene makeRoomScene()
{
  Scene scene;
  const Vec3 low{ { -3.0, 0.0, -2.5 } };
  const Vec3 high{ { 3.0, 2.8, 2.5 } };

  MeshBuilder table;
  addTable(table, { { -0.9, 0.0, -0.7 } }, { { 0.9, 0.75, 0.3 } }, 0.07, 0.04);
  // On the table: a box and a pile of books.
  table.addBox({ { 0.35, 0.75, -0.45 } }, { { 0.65, 0.95, -0.25 } });
  table.addBox({ { -0.6, 0.75, -0.4 } }, { { -0.3, 0.78, -0.2 } });
  table.addBox({ { -0.57, 0.78, -0.38 } }, { { -0.31, 0.82, -0.19 } });

  MeshBuilder chairs;
  for (const double side : { -1.0, 1.0 })
  {
    const double x = 1.5 * side - 0.25;
    addTable(chairs, { { x, 0.0, -0.4 } }, { { x + 0.5, 0.45, 0.1 } }, 0.05, 0.03);
    const double back = side < 0.0 ? x : x + 0.45;
    chairs.addBox({ { back, 0.45, -0.4 } }, { { back + 0.05, 0.95, 0.1 } });
  }

  // Open shelves along a wall, and a chest in the corner, with a gap to the walls.
  MeshBuilder cupboard;
  for (const double x : { -2.2, -1.4, -0.6 })
  {
    cupboard.addBox({ { x - 0.02, 0.0, -2.48 } }, { { x + 0.02, 2.0, -2.1 } });
  }
  for (int i = 0; i <= 4; ++i)
  {
    const double y = 0.1 + 0.47 * i;
    cupboard.addBox({ { -2.18, y, -2.48 } }, { { -1.42, y + 0.03, -2.1 } });
    cupboard.addBox({ { -1.38, y, -2.48 } }, { { -0.62, y + 0.03, -2.1 } });
  }
  cupboard.addBox({ { 1.6, 0.0, -2.4 } }, { { 2.8, 0.6, -1.8 } });

  scene.models = { makeModel("walls", makeHall(low, high), { { 0.8, 0.78, 0.72 } }),
    makeModel("table", table.build(), ochre), makeModel("chairs", chairs.build(), red),
    makeModel("cupboard", cupboard.build(), blue) };
  scene.camera = makeCamera({ { 2.7, 2.3, 2.2 } }, { { -0.7, 0.7, -1.0 } }, 70.0);
  scene.lights = { makeLamp({ { 0.5, 1.9, 0.4 } }) };
  return scene;
}

} // namespace gnomon::tool
