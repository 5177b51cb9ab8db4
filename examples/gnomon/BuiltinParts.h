#ifndef gnomon_examples_gnomon_BuiltinParts_h
#define gnomon_examples_gnomon_BuiltinParts_h

#include "Scene.h"

namespace gnomon::tool
{

/// A surface in one matt colour.
SceneModel makeModel(
  const std::string& name, vtkSmartPointer<vtkPolyData> surface, const Vec3& color);

/// A horizontal square of two triangles around a point, its front up.
SceneModel makePlane(const Vec3& center, double side);

/// A white directional light that travels that way.
SceneLight makeSun(const Vec3& travel);

/// A white light that shines from a point into all directions.
SceneLight makeLamp(const Vec3& position);

SceneCamera makeCamera(const Vec3& position, const Vec3& target, double fovDegrees);

} // namespace gnomon::tool

#endif
