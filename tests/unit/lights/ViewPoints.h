#pragma once

#include "lights/LightViews.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <random>
#include <vector>

namespace gnomon::test
{

/// Return points in a box: its corners and others.
inline std::vector<glm::dvec3> pointsIn(const Bounds& bounds)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto corners = bounds.corners();
  std::vector<glm::dvec3> points(corners.begin(), corners.end());
  for (int i = 0; i < 2000; ++i)
  {
    const glm::dvec3 share(uniform(random), uniform(random), uniform(random));
    points.push_back(bounds.lower + share * (bounds.upper - bounds.lower));
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

} // namespace gnomon::test
