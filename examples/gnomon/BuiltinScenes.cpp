#include "BuiltinScenes.h"

namespace gnomon::tool
{

//------------------------------------------------------------------------------
const std::vector<BuiltinSceneEntry>& builtinSceneEntries()
{
  static const std::vector<BuiltinSceneEntry> entries = {
    { { "bunny", "the Stanford bunny on a plane (needs the package glmark2-data)" },
      makeBunnyScene },
    { { "horse", "a horse on a plane (needs the package glmark2-data)" }, makeHorseScene },
    { { "cat", "a cat on a plane (needs the package glmark2-data)" }, makeCatScene },
    { { "cube", "a cube on a plane" }, makeCubeScene },
    { { "primitives", "torus, cylinder, pyramid and sphere on a plane, 4,944 triangles" },
      makePrimitivesScene },
    { { "posts", "thin posts and a fence" }, makePostsScene },
    { { "plates", "plates that rest on each other, or nearly" }, makePlatesScene },
    { { "room", "a furnished room with all six walls, lit by a point light inside" },
      makeRoomScene },
    { { "terrain", "a square kilometre of rolling terrain seen from 2 m above it, low sun" },
      makeTerrainScene },
  };
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
