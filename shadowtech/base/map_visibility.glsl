// The common part of pointwise techniques with a map: finds a point on the map and calls the
// technique's estimator. With LOOKS_AROUND_LIGHT the estimator looks from a cube's faces at more of
// the light than its centre.

#include "shadowtech/base/light_views.glsl"

// The classes of points: classesOfMaps(), in their order. A technique's own classes follow.
#ifndef GNOMON_MAP_CLASSES
#define GNOMON_MAP_CLASSES
#define MAP_TURNED_AWAY 1
#define MAP_NO_CASTER 2
#define MAP_BY_TEXELS 3

// The curved surface that a facet with smooth shading stands for (SmoothFacet.h): its normal in
// view coordinates, and its largest height in world units; height 0: none.
vec4 curvedView = vec4(0.0);
#endif
int pixelClass_LIGHT; // set by visibility_LIGHT() for its point

uniform vec2 depthSlacks_LIGHT; // rounding of a depth; and per distance to the camera

#if VIEWS_PIXELS_LIGHT
uniform vec2 pixelSide_LIGHT; // of a pixel across the view, in world units: x + y * distance

// Return the area of a surface that a pixel shows, in squared world units, which grows to infinity
// on surfaces along the view.
float pixelArea_LIGHT(vec3 positionView, vec3 normalView)
{
  float distanceView = -positionView.z;
  float side = pixelSide_LIGHT.x + pixelSide_LIGHT.y * distanceView;
  vec3 ray = pixelSide_LIGHT.y > 0.0 ? positionView / distanceView : vec3(0.0, 0.0, -1.0);
  return side * side / max(abs(dot(ray, normalize(normalView))), 1e-6);
}
#endif

// The technique's estimator, called for a point that findPoint_LIGHT() has found.
float estimate_LIGHT(ViewPoint point, float slack);

// Call the estimator with the rounding of depths at the point. The position is rounded relative to
// its distance from the camera, which is at most the sum of its coordinates' magnitudes.
float estimateAt_LIGHT(ViewPoint point, vec3 positionView)
{
  float distanceView = dot(abs(positionView), vec3(1.0));
  float slack =
    depthSlacks_LIGHT.x + viewDepths_LIGHT[point.view].x * distanceView * depthSlacks_LIGHT.y;
  return estimate_LIGHT(point, slack);
}

// Find a point that the light reaches on the map. Returns false if nothing on the map can hide the
// light from it.
bool findPoint_LIGHT(vec3 positionLight, vec3 normalLight, out ViewPoint point)
{
#ifdef LOOKS_AROUND_LIGHT
  return findFace_LIGHT(positionLight, normalLight, point);
#else
  return findView_LIGHT(positionLight, normalLight, point);
#endif
}

// Return the visibility of a point by the map, whether or not the light reaches it. `p` and `n` are
// its place and normal in light space.
float visibilityOnMap_LIGHT(vec3 p, vec3 n, vec3 positionView, vec3 normalView)
{
  ViewPoint point;
  if (!findPoint_LIGHT(p, n, point))
  {
    pixelClass_LIGHT = MAP_NO_CASTER;
    return 1.0;
  }
  pixelClass_LIGHT = MAP_BY_TEXELS; // the estimator may set another class
#if VIEWS_PIXELS_LIGHT
  point.pixelArea = pixelArea_LIGHT(positionView, normalView);
#endif
  float visibility = estimateAt_LIGHT(point, positionView);
#if VIEWS_BLENDED_LIGHT
  ViewPoint next;
  float share = blendIntoNext_LIGHT(point, next);
  if (share > 0.0)
  {
    visibility = mix(visibility, estimateAt_LIGHT(next, positionView), share);
  }
#endif
  return visibility;
}

float visibility_LIGHT(vec3 positionView, vec3 normalView)
{
  vec3 p = (lightFromView_LIGHT * vec4(positionView, 1.0)).xyz;
  vec3 n = mat3(lightFromView_LIGHT) * normalView;
  // A facet that faces away from the light may stand for a surface that does not. Then ask about a
  // point above all facets around, on no plane.
  vec3 toLight = toLight_LIGHT(p);
  vec3 curved = mat3(lightFromView_LIGHT) * curvedView.xyz;
  bool above = curvedView.w > 0.0 && !facesLight(n, toLight);
  pixelClass_LIGHT = MAP_TURNED_AWAY;
  if (!lightReaches_LIGHT(p, above ? curved : n))
  {
    return 0.0;
  }
  p += above ? curvedView.w * curved : vec3(0.0);
  n = above ? normalize(toLight) : n;
  return visibilityOnMap_LIGHT(p, n, positionView, normalView);
}

// Return the direction to the light in view coordinates, of any length.
vec3 towardsLight_LIGHT(vec3 positionView)
{
  vec3 p = (lightFromView_LIGHT * vec4(positionView, 1.0)).xyz;
  return transpose(mat3(lightFromView_LIGHT)) * toLight_LIGHT(p);
}

// Return the visibility of a place without a surface: it faces the light. A plane across parallel
// rays has one depth, so the compiler leaves out what visibility_LIGHT() does with planes.
float visibilityAt_LIGHT(vec3 positionView)
{
  vec3 p = (lightFromView_LIGHT * vec4(positionView, 1.0)).xyz;
  vec3 n = toLight_LIGHT(p);
  return lightReaches_LIGHT(p, n)
    ? visibilityOnMap_LIGHT(p, n, positionView, towardsLight_LIGHT(positionView))
    : 0.0;
}
