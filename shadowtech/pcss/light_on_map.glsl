// An area light as a receiver sees it on the one map that holds all it looks up: the light's shape,
// laid on the map by its Jacobian. light_around.glsl has the same of cubes.

struct SeenLight_LIGHT
{
  mat2 texels; // how the shape lies on the map at a separation of 1
  vec2 reach;  // how far it goes there
  vec3 facing; // how its axes and its centre face the receiver's plane
};

// The light is seen on the plane across the view, through its centre. Of a directional light it is
// at distance 1.
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

// The separation of what is at a depth of the map.
float separationOf_LIGHT(ViewPoint point, float depth)
{
  vec2 depths = viewDepths_LIGHT[point.view];
  float distanceLight = (depth - depths.y) / depths.x;
#if VIEWS_PERSPECTIVE_LIGHT
  // What touches the light is as good as what nearly does.
  float nearest = 1e-5 * point.position.z;
  return max(1.0 / max(distanceLight, nearest) - 1.0 / point.position.z, 0.0);
#else
  return max(point.position.z - distanceLight, 0.0);
#endif
}

// The separation of what hides the point where a point of the light is looked for; -1 where nothing
// does.
// @param beside that point, times the separation that it is looked for at
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

// The largest separation that a caster has within the light's reach at that separation. What the
// first steps find lies farther around than what the last one needs.
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
      break; // a step finds no less than what the next one would
    }
    separation = found;
    reach = light.reach * separation;
  }
  return separation;
}

// How many texels the receiver's plane is followed at a separation.
float texelsAcross_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation)
{
  vec2 farthest = min(light.reach * separation, vec2(viewSize_LIGHT));
  return max(farthest.x, farthest.y);
}

// What all say that may be looked up at a separation: 1 lit, 0 hidden, -1 where the map's bounds do
// not tell.
float decidedWithin_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation, float slack)
{
  return decided_LIGHT(point, light.reach * separation, slack);
}

// The least separation of casters where the map's bounds call all of that hidden.
float leastSeparation_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation)
{
  TexelWindow_LIGHT window = windowAround_LIGHT(point, light.reach * separation + 0.01);
  return separationOf_LIGHT(point, boundsOf_LIGHT(point, window).y);
}

// How a point of the light's shape is looked for in the search, and how much of the area around it
// that stands for: points lie denser in the middle, where low casters are found.
// @param place on return, of the largest separation
float spreadForSearch_LIGHT(inout vec2 place, SeenLight_LIGHT light, ViewPoint point, float largest)
{
  place *= extentOf_LIGHT(place);
  return 2.0 * extentOf_LIGHT(place);
}
