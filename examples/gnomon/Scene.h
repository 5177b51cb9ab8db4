#pragma once

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkProp3D.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::tool
{

using Vec3 = std::array<double, 3>;

/// One surface of a scene.
struct SceneModel
{
  std::string name;
  vtkSmartPointer<vtkPolyData> surface;
  /// World from model, row-major.
  std::array<double, 16> matrix{ { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
  vtkSmartPointer<vtkProperty> property; ///< how it looks; never null after loading
  vtkSmartPointer<vtkTexture> texture;   ///< its colour, or null
  bool casts = true;
  bool receives = true;
  bool oneSided = false;
  bool translucent = false; ///< drawn as translucent although its opacity is 1 (glTF's BLEND, MASK)
};

/// A prop that is more than a surface in a matt colour, in world coordinates. No file describes it.
struct SceneProp
{
  std::string name;
  std::function<vtkSmartPointer<vtkProp3D>()> make;
};

/// One light of a scene, in world coordinates.
struct SceneLight
{
  enum class Type
  {
    Directional,
    Spot,
    Point
  };
  /// What a directional light is limited to: see vtkGnomonLightKeys. The middle of its near face is
  /// the light's position.
  struct Box
  {
    double width = 0.0;
    double height = 0.0;
    double depth = 0.0;
    Vec3 up{ { 0, 1, 0 } };
  };
  /// What a light is that is more than a point: see vtkGnomonAreaLight.
  struct Area
  {
    bool rectangle = false; ///< else a disk
    double radius = 0.0;
    double width = 0.0;
    double height = 0.0;
    Vec3 up{ { 0, 1, 0 } };
    vtkSmartPointer<vtkImageData> texture; ///< how its colour is spread over it, or null
  };
  Type type = Type::Directional;
  Vec3 position{ { 0, 0, 1 } };
  Vec3 target{ { 0, 0, 0 } }; ///< directional: target - position is the way the light travels
  std::optional<Box> box;     ///< directional only
  std::optional<Area> area;   ///< around the position, across the way to the target
  Vec3 color{ { 1, 1, 1 } };
  double intensity = 1.0;
  double coneAngleDegrees = 30.0; ///< half the cone of a spot light
  /// What is asked of its shadows, by name (lights/ShadowSettings.h); the pass decides the rest.
  std::map<std::string, std::string> settings;
};

struct SceneCamera
{
  Vec3 position{ { 0, 0, 1 } };
  Vec3 target{ { 0, 0, 0 } };
  Vec3 up{ { 0, 1, 0 } };
  double fovDegrees = 30.0; ///< full vertical angle, of a perspective camera
  /// Half of the picture's height in world units, of a parallel camera.
  std::optional<double> parallelScale;
};

/// A scene as data: what a scene file, a model file or a built-in name leads to.
struct Scene
{
  std::string name;
  std::vector<SceneModel> models;
  std::vector<SceneProp> props;
  std::vector<SceneLight> lights;
  SceneCamera camera;
  Vec3 background{ { 1, 1, 1 } };
  /// What reading left out or replaced, for people; each a sentence that names the file.
  std::vector<std::string> notes;
};

/// Reads a built-in scene's name, a scene file (.json) or a model file (.obj .ply .stl .vtp .3ds
/// .glb .gltf). A model gets a ground, and a camera and a light where its file has none.
/// @param ground whether models stand on a ground; without it their file decides. Built-in scenes
/// take no ground.
/// @throws BadInput
Scene loadScene(const std::string& nameOrPath, std::optional<bool> ground = std::nullopt);

/// Reads the argument of --light, `type:key=value;key=value...`, with a scene file's types and
/// keys:
///     directional:direction=-1,-2,-1;color=1,1,1;intensity=1;technique=nsm;map_size=1024
///     spot:position=3,4,5;target=0,0,0;cone_angle=30;technique=pcf;kernel=box;kernel_size=5
///     point:position=3,4,5
/// @throws BadInput
SceneLight parseLight(const std::string& spec);

/// Reads the argument of --camera, `key=value;key=value...`, with a scene file's keys. What it
/// leaves out comes from `defaults`:
///     position=0,1,5;target=0,0,0;up=0,1,0;fov=45
///     parallel_scale=2
/// @throws BadInput
SceneCamera parseCamera(const std::string& spec, const SceneCamera& defaults);

///@{
/// Makes a renderer's lights, and a camera, those of a scene.
void setLights(vtkRenderer* renderer, const std::vector<SceneLight>& lights);
void setCamera(vtkCamera* camera, const SceneCamera& source);
///@}

/// A renderer with the scene's actors, props, lights, camera (clipping range set) and background.
/// Surfaces are shared with the scene and with other renderers made from it, all else is its own.
/// @param aspect the picture's width over its height
vtkSmartPointer<vtkRenderer> makeRenderer(const Scene& scene, double aspect);

} // namespace gnomon::tool
