#ifndef gnomon_examples_gnomon_BuiltinScenes_h
#define gnomon_examples_gnomon_BuiltinScenes_h

#include "Scene.h"

namespace gnomon::tool
{

/// A built-in scene: its line in the list, and how it is made.
struct BuiltinSceneEntry
{
  BuiltinScene line;
  Scene (*make)();
};

/// All of them, in the order in which they are listed to people.
const std::vector<BuiltinSceneEntry>& builtinSceneEntries();

///@{
/// Models of the package glmark2-data on a plane of four times their size, which casts too.
/// @throws BadInput when the package is not there (the environment variable GNOMON_MODELS may name
/// another folder)
Scene makeBunnyScene();
Scene makeHorseScene();
Scene makeCatScene();
///@}

/// A cube that stands on a plane.
Scene makeCubeScene();
/// Torus, cylinder, pyramid and sphere on a plane: 4,944 triangles.
Scene makePrimitivesScene();
/// Thin posts and a fence: shadows of about a texel's width.
Scene makePostsScene();
/// Plates that rest on each other, or nearly: contact shadows and small gaps.
Scene makePlatesScene();
/// A furnished room with all six walls and a lamp in it, seen from a corner.
Scene makeRoomScene();
/// A square kilometre of rolling terrain with trees, rocks and posts, seen from 2 m above it, under
/// a low sun.
Scene makeTerrainScene();

} // namespace gnomon::tool

#endif
