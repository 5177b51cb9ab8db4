#pragma once

#include "Scene.h"

namespace gnomon::tool
{

inline constexpr Vec3 origin{ { 0.0, 0.0, 0.0 } };
inline constexpr Vec3 up{ { 0.0, 1.0, 0.0 } };

/// Return a surface in one matt colour.
SceneModel makeModel(
  const std::string& name, vtkSmartPointer<vtkPolyData> surface, const Vec3& color);

/// Return a horizontal square of two triangles around a point, facing up.
SceneModel makePlane(const Vec3& center, double side);

/// Return the model rotated around the vertical axis, counter-clockwise seen from above, then
/// moved.
SceneModel placed(SceneModel model, const Vec3& position, double degrees);

/// Return a directional light.
SceneLight makeSun(
  const Vec3& travel, const Vec3& color = { { 1.0, 1.0, 1.0 } }, double intensity = 1.0);

/// Return a white point light.
SceneLight makeLamp(const Vec3& position);

/// Return the scene with a lamp instead of its sun. The lamp is a square spot light in the sun's
/// direction, at `distance` from the camera's target. Its side is a tenth of that distance. It
/// lights everything in the camera's view.
/// @param scene with one sun
Scene underLamp(Scene scene, double distance);

SceneCamera makeCamera(const Vec3& position, const Vec3& target, double fovDegrees);

} // namespace gnomon::tool
