#include "BuiltinScenes.h"

#include "BuiltinParts.h"
#include "HardScenes.h"

#include "lights/SettingsTable.h"

#include <algorithm>

namespace gnomon::tool
{

namespace
{

std::vector<BuiltinScene> makeScenes()
{
  std::vector<BuiltinScene> scenes = {
    { "bunny", "the Stanford bunny on a plane (needs the package glmark2-data)",
      [] {
        return makeModelOnPlane("bunny.obj", { { 0.8, 0.7, 0.55 } });
      } },
    { "horse", "a horse on a plane (needs the package glmark2-data)",
      [] {
        return makeModelOnPlane("horse.3ds", { { 0.62, 0.45, 0.32 } });
      } },
    { "cat", "a cat on a plane (needs the package glmark2-data)",
      [] {
        return makeModelOnPlane("cat.3ds", { { 0.55, 0.57, 0.62 } });
      } },
    { "cube", "a cube on a plane", makeCubeScene },
    { "posts", "thin posts and a fence", makePostsScene },
    { "plates", "plates that touch or nearly touch", makePlatesScene },
    { "half-plane", "a half plane over a plane, its shadow's edge is known", makeHalfPlaneScene },
    { "panels", "three planes above each other and three panels, open sheets", makePanelsScene },
    { "screens", "a lattice and a bent sheet, whose holes are cut out by textures",
      makeScreensScene },
    { "pole", "one tall, thin pole", makePoleScene },
    { "stack", "a cube above a sphere above a plane", makeStackScene },
    { "long-cube", "a hovering cube, long in the direction of the light", makeLongCubeScene },
    { "letter", "a concave letter C", makeLetterScene },
    { "cups", "twelve open cups of thin sheets", makeCupsScene },
    { "office", "a desk lamp of two spot lights in an office of a building", makeOfficeScene },
    { "room", "a furnished room with all six walls, lit by a point light inside", makeRoomScene },
    { "terrain", "a square kilometre of rolling terrain seen from 2 m above it, low sun",
      makeTerrainScene },
    { "props", "a prop of every kind that VTK has, on a ground", makePropsScene },
    { "molecule", "100,000 atoms and their bonds, drawn as spheres and sticks", makeMoleculeScene },
  };
  const auto addSoft = [&](const char* name, const char* summary, Scene (*make)(), double distance)
  {
    scenes.push_back({ name, summary, [=] { return underLamp(make(), distance); } });
  };
  addSoft("soft-stack", "stack under a square lamp", makeStackScene, 12.0);
  addSoft("soft-panels", "panels under a square lamp", makePanelsScene, 11.0);
  addSoft("soft-plates", "plates under a square lamp", makePlatesScene, 18.0);
  addSoft("soft-long-cube", "long-cube under a square lamp", makeLongCubeScene, 14.0);
  scenes.push_back({ "soft-window", "stack under a window of coloured panes", makeWindowScene });
  for (const SceneView& view : primitivesViews())
  {
    scenes.push_back({ view.name, view.summary, [view] { return makePrimitivesScene(view); } });
  }
  for (const SceneView& view : gardenViews())
  {
    scenes.push_back({ view.name, view.summary, [view] { return makeGardenScene(view); } });
  }
  scenes.push_back({ "atrium",
    "two storeys of arcades around a court with open cloth, 260,000 triangles", makeAtriumScene });
  scenes.push_back({ "building", "64 rooms with doors and a lamp each, most of them out of sight",
    makeBuildingScene });
  scenes.push_back(
    { "building-lit", "building with only the lamps in sight", makeLitBuildingScene });
  scenes.push_back({ "city",
    "streets and towers of 10 million triangles; ray traced in 2 GB of memory", makeCityScene });
  return scenes;
}

} // namespace

//------------------------------------------------------------------------------
const std::vector<BuiltinScene>& builtinScenes()
{
  static const std::vector<BuiltinScene> scenes = makeScenes();
  return scenes;
}

//------------------------------------------------------------------------------
const BuiltinScene* findBuiltinScene(const std::string& name)
{
  const auto hard = std::find_if(hardScenes().begin(), hardScenes().end(),
    [&](const HardScene& of) { return of.scene.name == name; });
  if (hard != hardScenes().end())
  {
    return &hard->scene;
  }
  const auto found = std::find_if(builtinScenes().begin(), builtinScenes().end(),
    [&](const BuiltinScene& scene) { return scene.name == name; });
  return found == builtinScenes().end() ? nullptr : &*found;
}

//------------------------------------------------------------------------------
std::string builtinSceneNames()
{
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtinScenes())
  {
    names.push_back(scene.name);
  }
  return listOf(names);
}

} // namespace gnomon::tool
