#pragma once

#include "Scene.h"

namespace gnomon::tool
{

inline constexpr Vec3 origin{ { 0.0, 0.0, 0.0 } };
inline constexpr Vec3 up{ { 0.0, 1.0, 0.0 } };

/// A surface in one matt colour.
SceneModel makeModel(
  const std::string& name, vtkSmartPointer<vtkPolyData> surface, const Vec3& color);

/// A horizontal square of two triangles around a point, its front up.
SceneModel makePlane(const Vec3& center, double side);

/// The model turned around the vertical axis, counter-clockwise seen from above, then moved.
SceneModel placed(SceneModel model, const Vec3& position, double degrees);

/// A directional light that travels that way.
SceneLight makeSun(
  const Vec3& travel, const Vec3& color = { { 1.0, 1.0, 1.0 } }, double intensity = 1.0);

/// A white light that shines from a point into all directions.
SceneLight makeLamp(const Vec3& position);

/// The scene under a lamp in place of its sun: a square that hangs where the sun comes from,
/// `distance` from what the camera looks at, its side a tenth of that. It is a spot light that
/// lights all that the camera looks at.
/// @param scene with one sun
Scene underLamp(Scene scene, double distance);

SceneCamera makeCamera(const Vec3& position, const Vec3& target, double fovDegrees);

} // namespace gnomon::tool
