#pragma once

#include "PassScene.h"

namespace gnomon::test
{

/// A light with an area, over a scene around the origin.
struct AreaLight
{
  const char* name;
  std::function<vtkLight*(PassScene& scene)> add;
  bool isTextured = false;
  bool followsCamera = false;
};
/// Return lights of all kinds and shapes.
const std::vector<AreaLight>& areaLights();
/// Return those whose place and colour are their own.
std::vector<AreaLight> plainAreaLights();

///@{
/// Add an area light. A rectangle is 0.6 times as high as it is wide.
vtkGnomonAreaLight* addRectangle(PassScene& scene, const glm::dvec3& position,
  const glm::dvec3& target, double width, double coneAngleDegrees);
vtkGnomonAreaLight* addDisk(PassScene& scene, const glm::dvec3& position, const glm::dvec3& target,
  double radius, double coneAngleDegrees);
vtkLight* addBall(PassScene& scene, const glm::dvec3& position, const char* radius);
vtkLight* addSoftSun(PassScene& scene, const glm::dvec3& direction, const char* degrees);
///@}

/// Multiply the size of a light's area.
void scaleArea(vtkLight* light, double factor);

/// Half a plane over a floor: its edge is the line x = 0, z = 2. The camera looks down at the floor
/// from below it.
struct HalfPlaneScene : PassScene
{
  static constexpr double edgeHeight = 2.0;
  HalfPlaneScene(int width, int height, double halfHeight);
};

/// The share of traced pixels and of wrong ones, of those that rays or maps decide.
struct Hints
{
  double traced = 0.0;
  double wrong = 0.0;
  double worst = 0.0; ///< the largest error
};
/// Compare an image of `coherence` with all rays. Pixels that no map decides equal the truth.
Hints hintsOf(const VisibilityImages& kept, const std::vector<float>& truth);

/// Return the distance over which a rising profile goes from 0.1 to 0.9, in its steps.
double widthOf(const std::vector<double>& profile);

} // namespace gnomon::test
