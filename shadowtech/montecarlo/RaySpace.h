#pragma once

#include "lights/LightView.h"
#include "lights/LightViews.h"
#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

#include <cmath>

namespace gnomon
{

/// @file
/// The space in which rays are traced through a light's map.
///
/// *Ray space* is (u, v, p): (u, v) is the place on the map in texels. The depth p grows away from
/// the light and is affine on planes. For parallel rays p is the map's linear depth. For rays from
/// a position it is -nearest / z, in [-1, 0), which is finest where the map is farthest.
///
/// A straight line in the world is straight in ray space. So rays go from texel to texel without a
/// division, as section 5.1 of Curtis 2009 wishes; the thesis itself uses eye depth.

inline bool stepsBack(const ShadowLight& light)
{
  return light.area && light.kind == LightKind::Spot && viewLayout(light) == ViewLayout::Single;
}

/// Return how far the light steps back. For an area of radius r across the light and a cone of half
/// angle a it is r / tan(a). For a ball, which the cone touches, it is r / sin(a). It is 0 for all
/// other lights.
inline double distanceToProjectionPoint(const ShadowLight& light)
{
  if (!stepsBack(light))
  {
    return 0.0;
  }
  const double angle = glm::radians(light.coneAngleDegrees);
  return light.area->radius() /
    (light.area->shape == LightArea::Shape::Ball ? std::sin(angle) : std::tan(angle));
}

/// Return the distance from the map's eye to the nearest point of the area. Casters before it are
/// behind the light.
inline double nearestOfArea(const ShadowLight& light)
{
  const bool ball = light.area && light.area->shape == LightArea::Shape::Ball;
  return distanceToProjectionPoint(light) - (ball && stepsBack(light) ? light.area->radius() : 0.0);
}

/// Return the light as the map of an area light sees it.
///
/// A spot light steps back until a cone of the same angle holds the original cone and the area in
/// front of it. So the map shows all that lies between a lit receiver and a point of the light (the
/// projection point of Curtis 2009, equation 3.1). Boxes are removed, as rays to the sides of a sun
/// leave them. Lights with the faces of a cube see all around, and stay as they are.
inline ShadowLight lightOfMap(const ShadowLight& light)
{
  ShadowLight seen = light;
  seen.positionWorld -= distanceToProjectionPoint(light) * light.directionWorld;
  seen.box.reset();
  return seen;
}

/// Return the matrix from centred coordinates to homogeneous ray space, with positive w in front of
/// the light. The view's map must be uniform.
/// @param sizeTexels side of the map
/// @param nearest the z at which p is -1, for positional lights; > 0
inline glm::dmat4 rayFromCentred(const LightView& view, int sizeTexels, double nearest)
{
  const glm::dmat3 texels = texelFromAcross(view, sizeTexels);
  // Each column holds what x, y, z or w of view space adds to (u, v, p, w).
  glm::dmat4 rayFromView(0.0);
  const auto place = [&](int column)
  { return glm::dvec4(texels[column].x, texels[column].y, 0.0, texels[column].z); };
  rayFromView[0] = place(0);
  rayFromView[1] = place(1);
  if (view.rays.positional)
  {
    rayFromView[2] = place(2);
    rayFromView[3].z = -nearest;
  }
  else
  {
    rayFromView[2].z = view.depthScale;
    rayFromView[3] = place(2) + glm::dvec4(0.0, 0.0, view.depthOffset, 0.0);
  }
  return rayFromView * view.rays.viewFromCentred;
}

} // namespace gnomon
