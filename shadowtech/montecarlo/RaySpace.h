#pragma once

#include "lights/LightView.h"
#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// @file
/// Where rays are traced through the map of a light.
///
/// *Ray space* is the map's place in texels, (u, v), with a depth p that grows away from the light
/// and is affine on planes: the map's linear depth of parallel rays; -nearest / z of those from a
/// position, in [-1, 0), which is finest where the map is farthest. A straight line in the world is
/// a straight line there, so that a ray is followed from texel to texel without a division (Curtis
/// 2009 has eye depth in its place, and section 5.1 wishes for this).

/// The light as the map of an area light sees it. A spot light steps back, to where its cone of the
/// same angle holds the cone and the area in front of it: so all that lies between a lit receiver
/// and a point of the light is on the map (the projection point of Curtis 2009, equation 3.1). A
/// box is taken away, since rays to the sides of a sun leave it. All else stays as it is, and so do
/// lights with the faces of a cube, which see all around.
ShadowLight lightOfMap(const ShadowLight& light);

/// How far the light steps back: for an area of radius r across the light and a cone of half angle
/// a, r / tan(a); of a ball, which the cone touches, r / sin(a). 0 without area, and of lights that
/// do not step back.
double distanceToProjectionPoint(const ShadowLight& light);

/// The distance from the map's eye of the part of the area that is nearest to it: casters before
/// that are behind the light.
double nearestOfArea(const ShadowLight& light);

/// From centred coordinates to ray space, homogeneous; w is positive in front of the light. The
/// view's map is uniform.
/// @param nearest the z at which p is -1, of a positional light; > 0
glm::dmat4 rayFromCentred(const LightView& view, int sizeTexels, double nearest);

} // namespace gnomon
