#pragma once

#include "lights/ShadowLight.h"

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

struct SceneModel
{
  std::string name;
  vtkSmartPointer<vtkPolyData> surface;
  /// The matrix from model to world, row-major.
  std::array<double, 16> matrix{ { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
  vtkSmartPointer<vtkProperty> property; ///< its look; never null after loading
  vtkSmartPointer<vtkTexture> texture;   ///< its colour, or null
  bool casts = true;
  bool receives = true;
  bool oneSided = false;
  bool translucent = false; ///< drawn as translucent although its opacity is 1 (glTF's BLEND, MASK)
};

/// Any other prop, in world coordinates. No file describes it.
struct SceneProp
{
  std::string name;
  std::function<vtkSmartPointer<vtkProp3D>()> make;
};

/// One light of a scene, in world coordinates.
struct SceneLight
{
  using Type = LightKind;
  /// The box of a directional light, see vtkGnomonLightKeys. Its near face is centred on the
  /// light's position.
  struct Box
  {
    double width = 0.0;
    double height = 0.0;
    double depth = 0.0;
    Vec3 up{ { 0, 1, 0 } };
  };
  /// The area of a light, see vtkGnomonAreaLight.
  struct Area
  {
    bool rectangle = false; ///< false: a disk
    double radius = 0.0;
    double width = 0.0;
    double height = 0.0;
    Vec3 up{ { 0, 1, 0 } };
    vtkSmartPointer<vtkImageData> texture; ///< the distribution of its colour; may be null
  };
  Type type = Type::Directional;
  Vec3 position{ { 0, 0, 1 } };
  Vec3 target{ { 0, 0, 0 } }; ///< directional: the light travels along target - position
  std::optional<Box> box;     ///< directional only
  std::optional<Area> area;   ///< around the position, across the direction to the target
  Vec3 color{ { 1, 1, 1 } };
  double intensity = 1.0;
  double coneAngleDegrees = 30.0; ///< half the cone of a spot light
  /// Settings of its shadows, by name (lights/ShadowSettings.h). The pass decides the rest.
  std::map<std::string, std::string> settings;
};

struct SceneCamera
{
  Vec3 position{ { 0, 0, 1 } };
  Vec3 target{ { 0, 0, 0 } };
  Vec3 up{ { 0, 1, 0 } };
  double fovDegrees = 30.0; ///< full vertical angle, of a perspective camera
  /// A parallel camera's half height of the picture, in world units; none: a perspective camera.
  std::optional<double> parallelScale;
};

/// A scene as data, from a scene file, a model file or a built-in name.
struct Scene
{
  std::string name;
  std::vector<SceneModel> models;
  bool isGlass = false; ///< translucent models let light through; else they block it
  std::vector<SceneProp> props;
  std::vector<SceneLight> lights;
  bool hasDefaultLight = false; ///< a model's file has none; see placeDefaultLight()
  SceneCamera camera;
  Vec3 background{ { 1, 1, 1 } };
  double sky = 0.0; ///< intensity of a sky; 0: none
  /// Parts that reading left out or replaced, for users; each a sentence with the file's name.
  std::vector<std::string> notes;
};

/// Load a scene from a built-in scene's name, a scene file (.json) or a model file (.obj .ply .stl
/// .vtp .3ds .glb .gltf). A model gets a ground, and a camera and a light if its file has none.
/// @param ground true: models stand on a ground; none: their file decides; built-in scenes ignore
/// it
/// @throws BadInput
Scene loadScene(const std::string& nameOrPath, std::optional<bool> ground = std::nullopt);

/// Parse the argument of --light, `type:key=value;key=value...`, with a scene file's types and
/// keys:
///     directional:direction=-1,-2,-1;color=1,1,1;intensity=1;technique=nsm;map_size=1024
///     spot:position=3,4,5;target=0,0,0;cone_angle=30;technique=pcf;kernel=box;kernel_size=5
///     point:position=3,4,5
/// @throws BadInput
SceneLight parseLight(const std::string& spec);

/// Parse the argument of --camera, `key=value;key=value...`, with a scene file's keys. Missing keys
/// come from `defaults`:
///     position=0,1,5;target=0,0,0;up=0,1,0;fov=45
///     parallel_scale=2
/// @throws BadInput
SceneCamera parseCamera(const std::string& spec, const SceneCamera& defaults);

///@{
/// Set the lights of a renderer, or a camera, to those of a scene.
void setLights(vtkRenderer* renderer, const std::vector<SceneLight>& lights);
void setCamera(vtkCamera* camera, const SceneCamera& source);
///@}

/// Place the light of a model without lights so that the camera sees its shadow
/// (vtkGnomonFlatteringLights). The surfaces' ambient light stands for the fill light. Other
/// scenes stay as they are.
/// @param aspect the picture's width divided by its height
void placeDefaultLight(Scene& scene, double aspect);

/// Return a renderer with the scene's actors, props, lights, camera (clipping range set) and
/// background. It shares surfaces with the scene and the scene's other renderers, and owns the
/// rest.
/// @param aspect the picture's width divided by its height
vtkSmartPointer<vtkRenderer> makeRenderer(const Scene& scene, double aspect);

} // namespace gnomon::tool
