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
  std::string summary; ///< one line
  std::function<Scene()> make;
};
/// Return all built-in scenes except the hard ones (HardScenes.h), in the order of listings.
const std::vector<BuiltinScene>& builtinScenes();
/// Find a built-in scene by its name, hard scenes included.
/// @return null without such a scene
const BuiltinScene* findBuiltinScene(const std::string& name);
/// Return all names for messages: "bunny, horse, ...".
std::string builtinSceneNames();

/// Return a model of the package glmark2-data on a plane of four times its size, which also casts.
/// @throws BadInput without the package (the environment variable GNOMON_MODELS may name another
/// folder)
Scene makeModelOnPlane(const std::string& file, const Vec3& color);

// BuiltinScene::summary describes most of these scenes.

Scene makeCubeScene();
/// Return thin posts and a fence, with shadows of about a texel's width.
Scene makePostsScene();
/// Return plates that touch or nearly touch: contact shadows and small gaps.
Scene makePlatesScene();
Scene makeRoomScene();
/// Return a hovering long cube along the light. The dark area below it depends on its depth.
Scene makeLongCubeScene();
Scene makeStackScene();
Scene makeWindowScene();
Scene makeLetterScene();
Scene makeCupsScene();
/// Return three planes above each other, larger ones below, and three panels on the lowest plane.
/// All are open sheets, and the panels' fronts face away from the light.
Scene makePanelsScene();
Scene makeScreensScene();
Scene makePoleScene();
/// The x of the half plane's shadow edge on the plane y = 0. Larger x are lit.
constexpr double halfPlaneShadowEdge = 1.25;
/// Return a half plane, x <= 0, at a height of 2.5 above a plane. The shadow's edge is a known
/// line.
Scene makeHalfPlaneScene();

Scene makeOfficeScene();
/// Return a court with two storeys of arcades, with banners and awnings of open cloth: about
/// 260,000 triangles. Size, light and camera are those of Sponza in Morais' thesis.
Scene makeAtriumScene();
Scene makeCityScene();
/// Return 64 rooms with a lamp each. The camera stands in one room, and only a few lamps light its
/// view.
Scene makeBuildingScene();
/// Return the same rooms with only those few lamps.
Scene makeLitBuildingScene();
Scene makeTerrainScene();
/// Return a prop of every kind that VTK has, on a ground.
Scene makePropsScene();
/// Return 100,000 atoms as balls, and their bonds as sticks.
Scene makeMoleculeScene();

/// A view of a scene that is listed once per view.
struct SceneView
{
  std::string name;
  std::string summary;
  Vec3 position;
  Vec3 direction;
};
/// Return the three views of Moderno's thesis, section 4.1.
const std::vector<SceneView>& primitivesViews();
Scene makePrimitivesScene(const SceneView& view);

/// Return the nine views of Morais' thesis, section 5.1.
const std::vector<SceneView>& gardenViews();
/// Return two trees, a lamp, a flower box and a bench on a lawn: 55,026 triangles, as in the
/// thesis.
Scene makeGardenScene(const SceneView& view);

} // namespace gnomon::tool
