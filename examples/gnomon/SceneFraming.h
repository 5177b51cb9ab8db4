#pragma once

#include "Scene.h"

namespace gnomon::tool
{

/// The box around the finite vertices of a scene's triangles, in world coordinates: x, y, z,
/// smallest and largest in turn. {0, 0, 0, 0, 0, 0} where there are none.
std::array<double, 6> boundsWorld(const Scene& scene);

/// A camera that shows the whole scene in a square picture, from the front and slightly above (y
/// up).
/// @param withShadow whether there is room for the shadow of the default light on a ground, too
SceneCamera framingCamera(const Scene& scene, bool withShadow);

/// Adds a horizontal square under the scene's models, four times as wide as they are large.
void addGround(Scene& scene);

/// Depths along the scene camera's view, in front of the eye.
struct DepthRange
{
  double nearest = 0.0;
  double farthest = 0.0; ///< less than `nearest` where there is nothing
};

/// Nearest and farthest point of the scene in the picture. Unlike the corners of a box around the
/// scene, these points are there: near planes that must not cut anything away can be set to them.
/// @param aspect the picture's width over its height
DepthRange visibleDepths(const Scene& scene, double aspect);

/// The light of models that bring none: directional, from the upper left in front.
SceneLight defaultLight();

/// The share of its colour that a surface shows where no light falls, if nothing else is said.
inline constexpr double defaultAmbient = 0.2;

/// Gives every surface that share of its colour where no light falls.
void setAmbient(Scene& scene, double share);

/// The look of surfaces that bring none: light grey and matt, with the default ambient light.
vtkSmartPointer<vtkProperty> defaultProperty();

/// Gives a surface the default look in that colour, in place of its own colours and textures. What
/// it shares with other surfaces stays as it is.
void paint(SceneModel& model, const Vec3& color);

} // namespace gnomon::tool
