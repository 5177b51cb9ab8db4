#include "BuiltinScenes.h"

#include "BuiltinParts.h"

namespace gnomon::tool
{

namespace
{

std::vector<BuiltinSceneEntry> makeEntries()
{
  std::vector<BuiltinSceneEntry> entries = {
    { { "bunny", "the Stanford bunny on a plane (needs the package glmark2-data)" },
      makeBunnyScene },
    { { "horse", "a horse on a plane (needs the package glmark2-data)" }, makeHorseScene },
    { { "cat", "a cat on a plane (needs the package glmark2-data)" }, makeCatScene },
    { { "cube", "a cube on a plane" }, makeCubeScene },
    { { "posts", "thin posts and a fence" }, makePostsScene },
    { { "plates", "plates that rest on each other, or nearly" }, makePlatesScene },
    { { "half-plane", "a half plane over a plane, its shadow's edge is known" },
      makeHalfPlaneScene },
    { { "panels", "three planes above each other and three panels, open sheets" },
      makePanelsScene },
    { { "screens", "a lattice and a bent sheet, whose holes are cut out by textures" },
      makeScreensScene },
    { { "pole", "one tall, thin pole" }, makePoleScene },
    { { "stack", "a cube above a sphere above a plane" }, makeStackScene },
    { { "long-cube", "a hovering cube, long in the direction of the light" }, makeLongCubeScene },
    { { "letter", "a concave letter C" }, makeLetterScene },
    { { "cups", "twelve open cups of thin sheets" }, makeCupsScene },
    { { "office", "a desk lamp of two spot lights in an office of a building" }, makeOfficeScene },
    { { "room", "a furnished room with all six walls, lit by a point light inside" },
      makeRoomScene },
    { { "terrain", "a square kilometre of rolling terrain seen from 2 m above it, low sun" },
      makeTerrainScene },
  };
  const auto addSoft = [&](const char* name, const char* summary, Scene (*make)(), double distance)
  {
    entries.push_back({ { name, summary }, [=] { return underLamp(make(), name, distance); } });
  };
  addSoft("soft-stack", "stack under a square lamp", makeStackScene, 12.0);
  addSoft("soft-panels", "panels under a square lamp", makePanelsScene, 11.0);
  addSoft("soft-plates", "plates under a square lamp", makePlatesScene, 18.0);
  addSoft("soft-long-cube", "long-cube under a square lamp", makeLongCubeScene, 14.0);
  entries.push_back(
    { { "soft-window", "stack under a window of coloured panes" }, makeWindowScene });
  for (const SceneView& view : primitivesViews())
  {
    entries.push_back({ view.line, [view] { return makePrimitivesScene(view); } });
  }
  for (const SceneView& view : gardenViews())
  {
    entries.push_back({ view.line, [view] { return makeGardenScene(view); } });
  }
  entries.push_back(
    { { "atrium", "two storeys of arcades around a court with open cloth, 260,000 triangles" },
      makeAtriumScene });
  entries.push_back(
    { { "city", "streets and towers of 10 million triangles; ray traced in 2 GB of memory" },
      makeCityScene });
  return entries;
}

} // namespace

//------------------------------------------------------------------------------
const std::vector<BuiltinSceneEntry>& builtinSceneEntries()
{
  static const std::vector<BuiltinSceneEntry> entries = makeEntries();
  return entries;
}

//------------------------------------------------------------------------------
std::vector<BuiltinScene> builtinScenes()
{
  std::vector<BuiltinScene> lines;
  for (const BuiltinSceneEntry& entry : builtinSceneEntries())
  {
    lines.push_back(entry.line);
  }
  return lines;
}

} // namespace gnomon::tool
