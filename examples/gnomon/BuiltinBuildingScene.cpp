#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "MeshBuilder.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <utility>

// A storey of 8 x 8 rooms with a lamp each, seen from inside one room. Lengths are metres.

namespace gnomon::tool
{

namespace
{

constexpr int roomsAlong = 8;
constexpr double roomSide = 5.0;
constexpr double roomHeightOfBuilding = 2.8;
constexpr double wallThickness = 0.2;

/// Add a wall of one room.
/// @param alongX true: the wall runs along x; false: along z
/// @param door distance from the wall's start to its door; negative: no door
void addRoomWall(MeshBuilder& mesh, const Vec3& start, bool alongX, double door)
{
  constexpr double doorWidth = 0.9;
  constexpr double doorHeight = 2.0;
  const auto addPart = [&](double from, double to, double low)
  {
    constexpr double half = 0.5 * wallThickness;
    mesh.addBox(start + Vec3{ { alongX ? from : -half, low, alongX ? -half : from } },
      start + Vec3{ { alongX ? to : half, roomHeightOfBuilding, alongX ? half : to } });
  };
  if (door < 0.0)
  {
    addPart(0.0, roomSide, 0.0);
    return;
  }
  addPart(0.0, door, 0.0);
  addPart(door, door + doorWidth, doorHeight);
  addPart(door + doorWidth, roomSide, 0.0);
}

/// Return rooms in rows of pairs. Doors join the rooms of a pair and consecutive rows, so a few
/// rooms are visible from each.
SceneModel makeRooms()
{
  constexpr double all = roomsAlong * roomSide;
  MeshBuilder mesh;
  mesh.addBox({ { 0.0, -wallThickness, 0.0 } }, { { all, 0.0, all } });
  mesh.addBox(
    { { 0.0, roomHeightOfBuilding, 0.0 } }, { { all, roomHeightOfBuilding + wallThickness, all } });
  for (int wall = 0; wall <= roomsAlong; ++wall)
  {
    for (int room = 0; room < roomsAlong; ++room)
    {
      addRoomWall(mesh, { { room * roomSide, 0.0, wall * roomSide } }, true, wall % 2 ? 0.7 : 3.4);
      addRoomWall(
        mesh, { { wall * roomSide, 0.0, room * roomSide } }, false, wall % 2 ? 3.4 : -1.0);
    }
  }
  return makeModel("rooms", mesh.build(), { { 0.8, 0.78, 0.72 } });
}

/// Return a table in each room.
SceneModel makeTables()
{
  MeshBuilder mesh;
  for (int i = 0; i < roomsAlong * roomsAlong; ++i)
  {
    const Vec3 middle{ { (i % roomsAlong + 0.4) * roomSide, 0.0,
      (i / roomsAlong + 0.4) * roomSide } };
    mesh.addCone(middle, 0.72, 0.06, 0.06, 16);
    mesh.addCone(middle + Vec3{ { 0.0, 0.72, 0.0 } }, 0.04, 0.6, 0.6, 32);
  }
  return makeModel("tables", mesh.build(), { { 0.6, 0.42, 0.27 } });
}

Vec3 lampOf(int column, int row)
{
  return { { (column + 0.5) * roomSide, roomHeightOfBuilding - 0.3, (row + 0.5) * roomSide } };
}

Scene makeUnlit()
{
  Scene scene;
  scene.models = { makeRooms(), makeTables() };
  scene.camera = makeCamera(
    { { 3.3 * roomSide, 1.6, 3.2 * roomSide } }, { { 3.7 * roomSide, 1.2, 3.9 * roomSide } }, 60.0);
  setAmbient(scene, 0.2);
  return scene;
}

void addRoomLamp(Scene& scene, int column, int row)
{
  scene.lights.push_back(makeLamp(lampOf(column, row)));
  scene.lights.back().intensity = 0.5;
}

} // namespace

//------------------------------------------------------------------------------
Scene makeBuildingScene()
{
  Scene scene = makeUnlit();
  for (int i = 0; i < roomsAlong * roomsAlong; ++i)
  {
    addRoomLamp(scene, i % roomsAlong, i / roomsAlong);
  }
  return scene;
}

//------------------------------------------------------------------------------
Scene makeLitBuildingScene()
{
  Scene scene = makeUnlit();
  for (const auto& [column, row] : { std::pair(2, 2), { 2, 3 }, { 3, 3 }, { 3, 4 } })
  {
    addRoomLamp(scene, column, row);
  }
  return scene;
}

} // namespace gnomon::tool
