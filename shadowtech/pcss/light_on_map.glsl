// An area light as a receiver sees it on a single map: the light's shape, mapped by the Jacobian.
// light_around.glsl is the version for cubes.

struct SeenLight_LIGHT
{
  mat2 texels; // from the shape to texels at a separation of 1
  vec2 reach;  // its extent in texels there
  vec3 facing; // how far its axes and its centre are in front of the receiver's plane
};

// Project the light to the plane across the view through its centre. A directional light is at
// distance 1.
SeenLight_LIGHT seenLight_LIGHT(ViewPoint point)
{
  mat2 across = mat2(lightFromUnit_LIGHT);
#if VIEWS_PERSPECTIVE_LIGHT
  float centre = -dot(point.normal, point.position);
#else
  float centre = -point.normal.z;
#endif
  mat2 texels = texelJacobian_LIGHT(point.view, acrossOf_LIGHT(point.position)) * across;
  vec2 reach = vec2(extentAlong_LIGHT(vec2(texels[0].x, texels[1].x)),
    extentAlong_LIGHT(vec2(texels[0].y, texels[1].y)));
  return SeenLight_LIGHT(texels, reach, vec3(point.normal.xy * across, centre));
}

// Return the separation of a caster at a depth of the map.
float separationOf_LIGHT(ViewPoint point, float depth)
{
  vec2 depths = viewDepths_LIGHT[point.view];
  float distanceLight = (depth - depths.y) / depths.x;
#if VIEWS_PERSPECTIVE_LIGHT
  // Casters that touch the light count as slightly farther.
  float nearest = 1e-5 * point.position.z;
  return max(1.0 / max(distanceLight, nearest) - 1.0 / point.position.z, 0.0);
#else
  return max(point.position.z - distanceLight, 0.0);
#endif
}

// Return the separation of the caster at the place where a point of the light is looked up; -1 if
// none hides that.
// @param beside the point times the separation of the lookup
float separationAt_LIGHT(ViewPoint point, SeenLight_LIGHT light, vec2 beside, float slack)
{
  vec2 place = point.texel + light.texels * beside;
  ivec2 texel = ivec2(clamp(floor(place), vec2(0.0), vec2(viewSize_LIGHT - 1.0)));
  float depth = depthAt_LIGHT(point.view, texel);
  if (isLitBy_LIGHT(point, texel, depth, point.position.z, slack))
  {
    return -1.0;
  }
  return separationOf_LIGHT(point, linearDepth_LIGHT(point.view, texel, depth));
}

// Return the largest separation of a caster within the light's reach at that separation. Each step
// searches a smaller area.
float largestSeparation_LIGHT(ViewPoint point, SeenLight_LIGHT light)
{
  vec2 reach = vec2(viewSize_LIGHT);
  float separation = 1e30;
  for (int i = 0; i < 4; ++i)
  {
    float nearest = boundsOf_LIGHT(point, windowAround_LIGHT(point, reach)).x;
    float found = separationOf_LIGHT(point, nearest);
    if (found >= separation)
    {
      break; // further steps find no less
    }
    separation = found;
    reach = light.reach * separation;
  }
  return separation;
}

// Return how many texels away the receiver's plane is evaluated at a separation.
float texelsAcross_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation)
{
  vec2 farthest = min(light.reach * separation, vec2(viewSize_LIGHT));
  return max(farthest.x, farthest.y);
}

// Decide all lookups at a separation by the map's bounds: 1 lit, 0 hidden, -1 undecided.
float decidedWithin_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation, float slack)
{
  return decided_LIGHT(point, light.reach * separation, slack);
}

// Return the least separation of casters, if the map's bounds decide that all lookups are hidden.
float leastSeparation_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation)
{
  TexelWindow_LIGHT window = windowAround_LIGHT(point, light.reach * separation + 0.01);
  return separationOf_LIGHT(point, boundsOf_LIGHT(point, window).y);
}

// Spread a point of the light's shape for the search, and return its weight: the share of the area
// around it. Points are denser in the middle, where low casters are found.
// @param place on return, relative to the largest separation
float spreadForSearch_LIGHT(inout vec2 place, SeenLight_LIGHT light, ViewPoint point, float largest)
{
  place *= extentOf_LIGHT(place);
  return 2.0 * extentOf_LIGHT(place);
}
