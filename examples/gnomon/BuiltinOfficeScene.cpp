#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "MeshBuilder.h"
#include "Noise.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <cmath>

// Apelles' figure 3.18: a lamp with two spot lights in an office of a building. Most of the
// building is out of the lights' reach. Lengths are metres.

namespace gnomon::tool
{

namespace
{

constexpr double roomWidth = 5.0;
constexpr double roomDepth = 4.0;
constexpr double roomHeight = 2.8;
constexpr int roomsAcross = 5;
constexpr int storeys = 3;

const Vec3 desk{ { 0.5, 0.0, -1.0 } }; ///< the middle of the desk's place on the floor
constexpr double deskHeight = 0.75;
const Vec3 bulb = desk + Vec3{ { -0.25, deskHeight + 0.55, -0.05 } };

/// Return floors, ceilings, partitions with doors, and a front with windows. The lit office is the
/// middle one of the middle storey, with its floor around the origin.
SceneModel makeBuilding()
{
  constexpr double wall = 0.12;
  constexpr double slab = 0.25;
  const double left = -0.5 * roomsAcross * roomWidth;
  const double back = -0.5 * roomDepth;
  const double front = 0.5 * roomDepth;
  MeshBuilder mesh;
  for (int storey = 0; storey <= storeys; ++storey)
  {
    const double y = (storey - 1) * (roomHeight + slab);
    mesh.addBox({ { left - 0.3, y - slab, back - 2.3 } }, { { -left + 0.3, y, front + 0.3 } });
    if (storey == storeys)
    {
      break;
    }
    const double top = y + roomHeight;
    for (int i = 0; i <= roomsAcross; ++i)
    {
      const double x = left + i * roomWidth;
      mesh.addBox({ { x - 0.5 * wall, y, back } }, { { x + 0.5 * wall, top, front } });
    }
    for (int i = 0; i < roomsAcross; ++i)
    {
      const double x0 = left + i * roomWidth + 0.5 * wall;
      const double x1 = x0 + roomWidth - wall;
      // Towards the corridor: a wall with a door's opening.
      const double z = back + wall;
      mesh.addBox({ { x0, y, back } }, { { x0 + 0.4, top, z } });
      mesh.addBox({ { x0 + 0.4, y + 2.1, back } }, { { x0 + 1.4, top, z } });
      mesh.addBox({ { x0 + 1.4, y, back } }, { { x1, top, z } });
      // Towards the street: sill, lintel, and mullions between three windows.
      const double outer = front - 0.2;
      mesh.addBox({ { x0, y, outer } }, { { x1, y + 0.9, front } });
      mesh.addBox({ { x0, y + 2.4, outer } }, { { x1, top, front } });
      for (int k = 0; k <= 3; ++k)
      {
        const double x = x0 + (x1 - x0 - 0.1) * k / 3.0;
        mesh.addBox({ { x, y + 0.9, outer + 0.05 } }, { { x + 0.1, y + 2.4, front - 0.05 } });
      }
    }
    // The corridor's far wall.
    mesh.addBox({ { left, y, back - 2.2 } }, { { -left, top, back - 2.1 } });
  }
  return makeModel("building", mesh.build(), { { 0.8, 0.79, 0.75 } });
}

/// Add a desk with drawers on one side.
void addDesk(MeshBuilder& mesh, const Vec3& place)
{
  const auto addBox = [&](const Vec3& low, const Vec3& high)
  { mesh.addBox(place + low, place + high); };
  addBox({ { -0.8, deskHeight - 0.03, -0.4 } }, { { 0.8, deskHeight, 0.4 } });
  addBox({ { -0.75, 0.0, -0.37 } }, { { -0.71, deskHeight - 0.03, 0.37 } });
  addBox({ { 0.3, 0.05, -0.37 } }, { { 0.75, deskHeight - 0.03, 0.36 } });
  for (int i = 0; i < 3; ++i)
  {
    const double y = 0.08 + 0.21 * i;
    addBox({ { 0.32, y, 0.36 } }, { { 0.73, y + 0.19, 0.375 } });
    addBox({ { 0.46, y + 0.12, 0.375 } }, { { 0.59, y + 0.135, 0.39 } });
  }
}

SceneModel makeDesks()
{
  MeshBuilder mesh;
  for (int storey = -1; storey < storeys - 1; ++storey)
  {
    for (int i = 0; i < roomsAcross; ++i)
    {
      const double x = (i - roomsAcross / 2) * roomWidth;
      addDesk(mesh, desk + Vec3{ { x, storey * (roomHeight + 0.25), 0.0 } });
    }
  }
  return makeModel("desks", mesh.build(), { { 0.6, 0.42, 0.27 } });
}

/// Return a swivel chair: five feet, a column, a seat, and a back of open mesh bars.
SceneModel makeChair()
{
  MeshBuilder mesh;
  for (int i = 0; i < 5; ++i)
  {
    const double angle = 1.2566 * i;
    const Vec3 direction{ { std::cos(angle), 0.0, std::sin(angle) } };
    mesh.addLathe({ Vec3{ { 0.0, 0.08, 0.0 } }, direction }, { { 0.03, 0.0 }, { 0.02, 0.3 } }, 8);
    mesh.addSphere(0.3 * direction + 0.04 * up, 0.04, 12, 8);
  }
  mesh.addCone({ { 0.0, 0.06, 0.0 } }, 0.38, 0.03, 0.03, 12);
  mesh.addBox({ { -0.24, 0.44, -0.24 } }, { { 0.24, 0.5, 0.24 } });
  for (int i = 0; i < 7; ++i)
  {
    const double x = -0.21 + 0.07 * i;
    mesh.addCone({ { x, 0.5, 0.22 } }, 0.5, 0.008, 0.008, 8);
  }
  mesh.addBox({ { -0.23, 1.0, 0.2 } }, { { 0.23, 1.06, 0.24 } });
  return makeModel("chair", mesh.build(), { { 0.3, 0.36, 0.45 } });
}

/// Add shelves along the wall to the corridor, and books, some of them leaning.
void addShelf(Scene& scene)
{
  MeshBuilder boards;
  MeshBuilder red, blue;
  Random random(7);
  const Vec3 corner{ { -0.8, 0.0, -1.87 } };
  boards.addBox(corner, corner + Vec3{ { 0.03, 2.0, 0.3 } });
  boards.addBox(corner + Vec3{ { 2.97, 0.0, 0.0 } }, corner + Vec3{ { 3.0, 2.0, 0.3 } });
  for (int shelf = 0; shelf < 6; ++shelf)
  {
    const double y = 0.05 + 0.38 * shelf;
    boards.addBox(corner + Vec3{ { 0.03, y, 0.0 } }, corner + Vec3{ { 2.97, y + 0.025, 0.3 } });
    double x = 0.05;
    while (shelf < 5 && x < 2.85)
    {
      const double width = random.between(0.02, 0.06);
      const double height = random.between(0.2, 0.32);
      if (random.between(0.0, 1.0) < 0.85)
      {
        MeshBuilder& books = random.between(0.0, 1.0) < 0.5 ? red : blue;
        books.addBox(corner + Vec3{ { x, y + 0.025, 0.02 } },
          corner + Vec3{ { x + width, y + 0.025 + height, random.between(0.2, 0.27) } });
      }
      x += width + 0.004;
    }
  }
  scene.models.push_back(makeModel("shelf", boards.build(), { { 0.55, 0.45, 0.36 } }));
  scene.models.push_back(makeModel("red books", red.build(), { { 0.6, 0.25, 0.22 } }));
  scene.models.push_back(makeModel("blue books", blue.build(), { { 0.26, 0.38, 0.52 } }));
}

/// Add an open mug with pencils, and a pile of paper with rotated, overhanging sheets.
void addThingsOnTheDesk(Scene& scene)
{
  const Vec3 top = desk + deskHeight * up;
  MeshBuilder mug;
  const Vec3 foot = top + Vec3{ { 0.1, 0.0, 0.12 } };
  mug.addLathe(
    { foot, up }, { { 0.0, 0.004 }, { 0.036, 0.004 }, { 0.042, 0.02 }, { 0.042, 0.1 } }, 32);
  scene.models.push_back(makeModel("mug", mug.build(), { { 0.8, 0.8, 0.84 } }));

  MeshBuilder pencils;
  for (int i = 0; i < 5; ++i)
  {
    const double angle = 1.3 * i;
    const Vec3 lean{ { 0.2 * std::cos(angle), 1.0, 0.2 * std::sin(angle) } };
    pencils.addLathe({ foot + 0.006 * up, normalized(lean) },
      { { 0.004, 0.0 }, { 0.004, 0.16 }, { 0.0, 0.18 } }, 6);
  }
  scene.models.push_back(makeModel("pencils", pencils.build(), { { 0.85, 0.65, 0.2 } }));

  MeshBuilder paper;
  for (int i = 0; i < 12; ++i)
  {
    // Single sheets, a millimetre apart, the upper ones curled.
    const double angle = 0.2 + 0.04 * ((i * 5) % 12);
    const Vec3 middle = top + Vec3{ { -0.38, 0.001 * (i + 1), 0.2 } };
    const Vec3 right{ { std::cos(angle), 0.0, -std::sin(angle) } };
    const Vec3 back{ { std::sin(angle), 0.0, std::cos(angle) } };
    paper.addSheet(6, 6,
      [&](double u, double v)
      {
        const double curl = 0.002 * i * (2.0 * u - 1.0) * (2.0 * u - 1.0) * v;
        return middle + (0.21 * (u - 0.5)) * right - (0.297 * (v - 0.5)) * back + curl * up;
      });
  }
  scene.models.push_back(makeModel("paper", paper.build(), { { 0.92, 0.92, 0.9 } }));

  MeshBuilder screen;
  screen.addBox(top + Vec3{ { 0.2, 0.1, -0.25 } }, top + Vec3{ { 0.72, 0.42, -0.22 } });
  screen.addBox(top + Vec3{ { 0.44, 0.02, -0.26 } }, top + Vec3{ { 0.48, 0.25, -0.25 } });
  screen.addBox(top + Vec3{ { 0.35, 0.0, -0.32 } }, top + Vec3{ { 0.57, 0.02, -0.16 } });
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 13; ++column)
    {
      const Vec3 key = top + Vec3{ { 0.25 + 0.03 * column + 0.006 * row, 0.0, 0.0 + 0.03 * row } };
      screen.addBox(key, key + Vec3{ { 0.026, 0.012, 0.026 } });
    }
  }
  scene.models.push_back(makeModel("screen", screen.build(), { { 0.22, 0.23, 0.25 } }));
}

/// Add a lamp: a foot, two arms with a joint, and a shade, an open sheet around the bulb's place.
void addLamp(Scene& scene)
{
  const Vec3 foot = desk + Vec3{ { -0.6, deskHeight, -0.2 } };
  const Vec3 joint = foot + Vec3{ { -0.1, 0.45, 0.0 } };
  const Vec3 neck = bulb + Vec3{ { -0.07, 0.1, -0.03 } };
  MeshBuilder metal;
  metal.addCone(foot, 0.02, 0.1, 0.1, 32);
  const auto addArm = [&](const Vec3& from, const Vec3& to)
  {
    const double size = length(to - from);
    metal.addLathe({ from, normalized(to - from) },
      { { 0.0, 0.0 }, { 0.009, 0.0 }, { 0.009, size }, { 0.0, size } }, 12);
  };
  addArm(foot + 0.02 * up, joint);
  addArm(joint, neck);
  metal.addSphere(joint, 0.02, 16, 10);
  scene.models.push_back(makeModel("lamp", metal.build(), { { 0.35, 0.36, 0.38 } }));

  MeshBuilder shade;
  shade.addLathe({ bulb, up }, { { 0.15, -0.1 }, { 0.14, -0.06 }, { 0.07, 0.1 } }, 48);
  scene.models.push_back(makeModel("shade", shade.build(), { { 0.75, 0.3, 0.2 } }));
}

} // namespace

//------------------------------------------------------------------------------
Scene makeOfficeScene()
{
  Scene scene;
  scene.models = { makeBuilding(), makeDesks(),
    placed(makeChair(), { { 0.35, 0.0, -0.1 } }, 25.0) };
  addShelf(scene);
  addThingsOnTheDesk(scene);
  addLamp(scene);
  scene.camera = makeCamera({ { -1.7, 1.6, 1.5 } }, { { 0.4, 1.12, -1.1 } }, 58.0);

  // Both cones are wider than the shade's openings, so the shade's rims bound the light.
  SceneLight down;
  down.type = SceneLight::Type::Spot;
  down.position = bulb;
  down.target = bulb - up;
  down.coneAngleDegrees = 59.0;
  down.intensity = 1.4;
  down.color = { { 1.0, 0.93, 0.8 } };
  SceneLight upwards = down;
  upwards.target = bulb + up;
  upwards.coneAngleDegrees = 45.0;
  scene.lights = { down, upwards };
  setAmbient(scene, 0.3);
  scene.background = { { 0.04, 0.05, 0.09 } };
  return scene;
}

} // namespace gnomon::tool
