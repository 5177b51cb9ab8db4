#pragma once

#include "Scene.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::tool
{

struct BuiltinScene
{
  std::string name;
  std::string summary; ///< a line
  std::function<Scene()> make;
};
/// All of them but the hard ones (HardScenes.h), in the order in which they are listed to people.
const std::vector<BuiltinScene>& builtinScenes();
/// Finds a hard one, too.
/// @return null if there is none of that name
const BuiltinScene* findBuiltinScene(const std::string& name);
/// "bunny, horse, ...": for messages.
std::string builtinSceneNames();

/// A model of the package glmark2-data on a plane of four times its size, which casts too.
/// @throws BadInput when the package is not there (the environment variable GNOMON_MODELS may name
/// another folder)
Scene makeModelOnPlane(const std::string& file, const Vec3& color);

// Their summaries say what most of them are.

Scene makeCubeScene();
/// Thin posts and a fence: shadows of about a texel's width.
Scene makePostsScene();
/// Plates that rest on each other, or nearly: contact shadows and small gaps.
Scene makePlatesScene();
Scene makeRoomScene();
/// A long cube that hovers, its length along the light: what is dark below it depends on its depth.
Scene makeLongCubeScene();
Scene makeStackScene();
Scene makeWindowScene();
Scene makeLetterScene();
Scene makeCupsScene();
/// Three planes above each other that grow downwards, and three panels that stand on the lowest;
/// all are open sheets, and the panels' fronts look away from the light.
Scene makePanelsScene();
Scene makeScreensScene();
Scene makePoleScene();
/// Where the shadow of the half plane's edge falls on the plane y = 0: lit for x above it.
constexpr double halfPlaneShadowEdge = 1.25;
/// A half plane, x <= 0, at a height of 2.5 over a plane: the shadow's edge is a known line.
Scene makeHalfPlaneScene();

Scene makeOfficeScene();
/// A court with two storeys of arcades, with banners and awnings of open cloth, about 260,000
/// triangles; size, light and camera are those of Sponza in Morais' thesis.
Scene makeAtriumScene();
Scene makeCityScene();
/// 64 rooms with a lamp each, of which a few light what the camera sees in one of them.
Scene makeBuildingScene();
/// The same with those few alone.
Scene makeLitBuildingScene();
Scene makeTerrainScene();
/// A prop of every kind that VTK has, on a ground.
Scene makePropsScene();
/// 100,000 atoms as balls, and their bonds as sticks.
Scene makeMoleculeScene();

/// A view of a scene that is listed once for each of its views.
struct SceneView
{
  std::string name;
  std::string summary;
  Vec3 position;
  Vec3 direction;
};
/// The three of Moderno's thesis, section 4.1.
const std::vector<SceneView>& primitivesViews();
Scene makePrimitivesScene(const SceneView& view);

/// The nine of Morais' thesis, section 5.1.
const std::vector<SceneView>& gardenViews();
/// Two trees, a lamp, a flower box and a bench on a lawn: 55,026 triangles as in the thesis.
Scene makeGardenScene(const SceneView& view);

} // namespace gnomon::tool
