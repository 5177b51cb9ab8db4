#pragma once

#include "lights/LightView.h"
#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

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

/// Return the light as the map of an area light sees it.
///
/// A spot light steps back until a cone of the same angle holds the original cone and the area in
/// front of it. So the map shows all that lies between a lit receiver and a point of the light (the
/// projection point of Curtis 2009, equation 3.1). Boxes are removed, as rays to the sides of a sun
/// leave them. Lights with the faces of a cube see all around, and stay as they are.
ShadowLight lightOfMap(const ShadowLight& light);

/// Return how far the light steps back. For an area of radius r across the light and a cone of half
/// angle a it is r / tan(a). For a ball, which the cone touches, it is r / sin(a). It is 0 for all
/// other lights.
double distanceToProjectionPoint(const ShadowLight& light);

/// Return the distance from the map's eye to the nearest point of the area. Casters before it are
/// behind the light.
double nearestOfArea(const ShadowLight& light);

/// Return the matrix from centred coordinates to homogeneous ray space, with positive w in front of
/// the light. The view's map must be uniform.
/// @param sizeTexels side of the map
/// @param nearest the z at which p is -1, for positional lights; > 0
glm::dmat4 rayFromCentred(const LightView& view, int sizeTexels, double nearest);

} // namespace gnomon
