#pragma once

#include "Random.h"

#include "lights/LightViews.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon::test
{

/// Return points in a box: its corners and others.
inline std::vector<glm::dvec3> pointsIn(const Bounds& bounds)
{
  Random random(11);
  const auto corners = bounds.corners();
  std::vector<glm::dvec3> points(corners.begin(), corners.end());
  for (int i = 0; i < 2000; ++i)
  {
    points.push_back(bounds.centre() + inCube(random, 0.5) * (bounds.upper - bounds.lower));
  }
  return points;
}

/// Return the view that sees a point, as shaders find it; null if none does.
inline const LightView* viewOf(const LightViews& views, const glm::dvec3& centred)
{
  int view = 0;
  if (views.layout == ViewLayout::Cube)
  {
    const glm::dvec3 light(views.lightFromCentred * glm::dvec4(centred, 1.0));
    view = views.viewOfFace[static_cast<std::size_t>(cubeFaceOf(light))];
  }
  const auto index = static_cast<std::size_t>(view);
  return view != LightViews::noView && index < views.views.size() ? &views.views[index] : nullptr;
}

/// Return where a camera sees a plane.
/// @param device the place in the picture, in device coordinates
/// @param plane n and d of n.p + d = 0, centred
inline glm::dvec3 seenAt(
  const CameraView& camera, const glm::dvec2& device, const glm::dvec4& plane)
{
  const glm::dmat4 centredFromClip = glm::inverse(camera.clipFromCentred());
  const glm::dvec4 front = centredFromClip * glm::dvec4(device, -1.0, 1.0);
  const glm::dvec4 back = centredFromClip * glm::dvec4(device, 1.0, 1.0);
  const glm::dvec4 from = front / front.w, to = back / back.w;
  const double height = glm::dot(plane, from);
  return glm::dvec3(glm::mix(from, to, height / (height - glm::dot(plane, to))));
}

} // namespace gnomon::test
