#pragma once

#include "Scene.h"

namespace gnomon::tool
{

/// Return the box around the finite vertices of a scene's triangles, in world coordinates: smallest
/// and largest x, y, z, alternating. Without vertices, return {0, 0, 0, 0, 0, 0}.
std::array<double, 6> boundsWorld(const Scene& scene);

/// Return a camera that shows the whole scene in a square picture, from the front and slightly
/// above (y up).
/// @param withShadow true: the picture also has room for the default light's shadow on a ground
SceneCamera framingCamera(const Scene& scene, bool withShadow);

/// Add a horizontal square under the scene's models, four times their size.
void addGround(Scene& scene);

/// Depths along the scene camera's view, in front of the eye.
struct DepthRange
{
  double nearest = 0.0;
  double farthest = 0.0; ///< less than `nearest` if nothing is visible
};

/// Return the depths of the nearest and farthest point of the scene in the picture. They are exact,
/// unlike those of a bounding box' corners, so clipping planes can be set to them.
/// @param aspect the picture's width over its height
DepthRange visibleDepths(const Scene& scene, double aspect);

/// Return the light of models without lights: directional, from the upper left in front.
SceneLight defaultLight();

/// The default share of its colour that a surface shows where no light falls.
inline constexpr double defaultAmbient = 0.2;

/// Set the share of its colour that every surface shows where no light falls.
void setAmbient(Scene& scene, double share);

/// Return the look of surfaces without material: light grey and matt, with the default ambient
/// light.
vtkSmartPointer<vtkProperty> defaultProperty();

/// Give a surface the default look in a colour, instead of its own colours and textures. Data that
/// it shares with other surfaces stays unchanged.
void paint(SceneModel& model, const Vec3& color);

} // namespace gnomon::tool
