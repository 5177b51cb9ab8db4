#pragma once

#include "Scene.h"

#include <functional>

namespace gnomon::tool
{

/// A built-in scene: its line in the list, and how it is made.
struct BuiltinSceneEntry
{
  BuiltinScene line;
  std::function<Scene()> make;
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
/// Thin posts and a fence: shadows of about a texel's width.
Scene makePostsScene();
/// Plates that rest on each other, or nearly: contact shadows and small gaps.
Scene makePlatesScene();
/// A furnished room with all six walls and a lamp in it, seen from a corner.
Scene makeRoomScene();
/// A long cube that hovers, its length along the light: what is dark below it depends on its depth.
Scene makeLongCubeScene();
/// A cube above a sphere above a plane, lit from above.
Scene makeStackScene();
/// The stack under a window of four panes, red, yellow, green and blue, with dark bars between
/// them.
Scene makeWindowScene();
/// A concave letter C that stands on a plane: gaps between casters that lie above each other.
Scene makeLetterScene();
/// Twelve open cups of thin sheets over a plane.
Scene makeCupsScene();
/// Three planes above each other that grow downwards, and three panels that stand on the lowest;
/// all are open sheets, and the panels' fronts look away from the light.
Scene makePanelsScene();
/// A lattice and a bent sheet with round holes above a plane. The holes are those of textures.
Scene makeScreensScene();
/// One tall, thin, round pole.
Scene makePoleScene();

/// Where the shadow of the half plane's edge falls on the plane y = 0: lit for x above it.
constexpr double halfPlaneShadowEdge = 1.25;
/// A half plane, x <= 0, at a height of 2.5 over a plane: the shadow's edge is a known line.
Scene makeHalfPlaneScene();

/// A desk lamp of two spot lights, up and down, in one office of a building.
Scene makeOfficeScene();
/// A court with two storeys of arcades, with banners and awnings of open cloth, about 260,000
/// triangles; size, light and camera are those of Sponza in Morais' thesis.
Scene makeAtriumScene();
/// Streets and towers, whose windows and ledges are triangles: 10 million of them.
Scene makeCityScene();

/// A view of a scene that is listed once for each of its views.
struct SceneView
{
  BuiltinScene line;
  Vec3 position;
  Vec3 direction;
};
/// The three of Moderno's thesis, section 4.1.
const std::vector<SceneView>& primitivesViews();
/// Torus, cylinder, pyramid and sphere on a plane: 4,944 triangles.
Scene makePrimitivesScene(const SceneView& view);

/// The nine of Morais' thesis, section 5.1.
const std::vector<SceneView>& gardenViews();
/// Two trees, a lamp, a flower box and a bench on a lawn: 55,026 triangles as in the thesis.
Scene makeGardenScene(const SceneView& view);

/// A square kilometre of rolling terrain with trees, rocks and posts, seen from 2 m above it, under
/// a low sun.
Scene makeTerrainScene();

} // namespace gnomon::tool
