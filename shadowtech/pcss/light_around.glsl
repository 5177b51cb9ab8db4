// An area light as a receiver sees it from the middle of a cube's faces. L is a point of the light
// and P the receiver, both relative to the light's centre. A caster X that hides L from P lies on
// the way between them. So it lies on the centre's ray through
//     P + L s,   s = |PX| / |XL|,
// from P at the receiver to L at the light. The face is this ray's, whichever face the receiver is
// on.

struct SeenLight_LIGHT
{
  mat2x3 axes; // of the shape, in the space of the receiver's face
  vec3 normal; // of its plane, of any length
  vec3 facing; // how far the axes and the centre are in front of the receiver's plane
  float most;  // the largest separation for which the map has enough texels
};

// The fewest texels between the ray of a separation and the light's rim.
const float texelsToRim_LIGHT = 8.0;

// Return the axes of a ball's outline: the disk across the way from its centre to the receiver. The
// disk is the same from every face. Its axes are those of the plane across the face, turned the
// shortest way.
mat2x3 ballAcross_LIGHT(float radius, vec3 position)
{
  vec3 away = normalize(position); // not along -z, as the receiver is on the face
  mat2 turned = mat2(1.0) - outerProduct(away.xy, away.xy) / (1.0 + away.z);
  return radius * mat2x3(vec3(turned[0], -away.x), vec3(turned[1], -away.y));
}

SeenLight_LIGHT seenLight_LIGHT(ViewPoint point)
{
#if PCSS_BALL_LIGHT
  mat2x3 axes = ballAcross_LIGHT(length(lightFromUnit_LIGHT[0]), point.position);
#else
  mat2x3 axes = mat2x3(cubeFaceFromLight(point.face, lightFromUnit_LIGHT[0]),
    cubeFaceFromLight(point.face, lightFromUnit_LIGHT[1]));
#endif
  float radius = max(length(axes[0]), length(axes[1]));
  vec2 texels = abs(viewTexels_LIGHT[point.view].xy);
  float most = length(point.position) * min(texels.x, texels.y) / (texelsToRim_LIGHT * radius);
  return SeenLight_LIGHT(axes, cross(axes[0], axes[1]),
    vec3(point.normal * axes, -dot(point.normal, point.position)), most);
}

// Convert a vector from the receiver's face to another one.
vec3 onFace_LIGHT(ViewPoint point, int face, vec3 v)
{
  return face == point.face ? v : cubeFaceFromLight(face, lightFromCubeFace(point.face, v));
}

// Convert the receiver to another face, which need not see it.
ViewPoint onFace_LIGHT(ViewPoint point, int face)
{
  point.position = onFace_LIGHT(point, face, point.position);
  point.normal = onFace_LIGHT(point, face, point.normal);
  point.view = viewOfFace_LIGHT[face];
  point.face = face;
  return point;
}

// Return the distance from the light along a face's axis that a depth of its map means.
float distanceOf_LIGHT(ViewPoint onFace, float depth)
{
  vec2 depths = viewDepths_LIGHT[onFace.view];
  return (depth - depths.y) / depths.x;
}

// Return the slack of another face. Faces of larger depths round these less.
float slackOn_LIGHT(ViewPoint onFace, ViewPoint point, float slack)
{
  return slack * max(viewDepths_LIGHT[onFace.view].x / viewDepths_LIGHT[point.view].x, 1.0);
}

// Return the separation of the caster at the place where a point of the light is looked up; -1 if
// none hides that.
// @param beside the point times the separation of the lookup
float separationAt_LIGHT(ViewPoint point, SeenLight_LIGHT light, vec2 beside, float slack)
{
  vec3 ray = point.position + light.axes * beside;
  int face = cubeFaceOf(lightFromCubeFace(point.face, ray));
  ViewPoint onFace = onFace_LIGHT(point, face);
  if (onFace.view < 0)
  {
    return -1.0;
  }
  ray = onFace_LIGHT(point, face, ray);
  // The longest coordinate: the ray ends at the light's centre, which nothing hides.
  if (ray.z == 0.0)
  {
    return -1.0;
  }
  vec2 place = texelOf_LIGHT(onFace.view, ray.xy / ray.z);
  ivec2 texel = ivec2(clamp(floor(place), vec2(0.0), vec2(viewSize_LIGHT - 1.0)));
  float depth = depthAt_LIGHT(onFace.view, texel);
  if (isLitBy_LIGHT(onFace, texel, depth, ray.z, slackOn_LIGHT(onFace, point, slack)))
  {
    return -1.0;
  }
  depth = linearDepth_LIGHT(onFace.view, texel, depth);
  float nearest = ray.z / (1.0 + light.most);
  return max(ray.z / max(distanceOf_LIGHT(onFace, depth), nearest) - 1.0, 0.0);
}

// The part of a face that may be looked up at a separation.
struct FaceWindow_LIGHT
{
  bool any;
  vec2 lower; // slopes
  vec2 upper;
  TexelWindow_LIGHT texels; // only valid if the face has a view
  vec2 own; // the least and the largest distance of a ray at the receiver, along the face's axis
};

// Return the largest m in [-1, 1] for which x >= m z holds for all corners, and so for all between
// them.
float leastSlope_LIGHT(vec4 x, vec4 z)
{
  vec2 range = vec2(-1.0, 1.0);
  for (int i = 0; i < 4; ++i)
  {
    float slope = x[i] / z[i];
    range.y = z[i] > 0.0 ? min(range.y, slope) : range.y;
    range.x = z[i] < 0.0 ? max(range.x, slope) : range.x;
    range.x = z[i] == 0.0 && x[i] < 0.0 ? 2.0 : range.x;
  }
  return range.x <= range.y ? range.y : -1.0;
}

FaceWindow_LIGHT windowOn_LIGHT(
  ViewPoint onFace, ViewPoint point, SeenLight_LIGHT light, float separation)
{
  // Corners of a parallelogram around the shape.
  vec3 first = onFace_LIGHT(point, onFace.face, separation * light.axes[0]);
  vec3 second = onFace_LIGHT(point, onFace.face, separation * light.axes[1]);
  const vec4 firsts = vec4(1.0, 1.0, -1.0, -1.0);
  const vec4 seconds = vec4(1.0, -1.0, 1.0, -1.0);
  vec4 x = onFace.position.x + firsts * first.x + seconds * second.x;
  vec4 y = onFace.position.y + firsts * first.y + seconds * second.y;
  vec4 z = onFace.position.z + firsts * first.z + seconds * second.z;
  FaceWindow_LIGHT window;
  window.own = vec2(least_LIGHT(z), largest_LIGHT(z));
  window.any = window.own.y > 0.0 && !all(greaterThan(x, z)) && !all(greaterThan(-x, z)) &&
    !all(greaterThan(y, z)) && !all(greaterThan(-y, z));
  if (window.any)
  {
    window.lower = vec2(leastSlope_LIGHT(x, z), leastSlope_LIGHT(y, z));
    window.upper = -vec2(leastSlope_LIGHT(-x, z), leastSlope_LIGHT(-y, z));
  }
  if (window.any && onFace.view >= 0)
  {
    vec2 a = texelOf_LIGHT(onFace.view, window.lower);
    vec2 b = texelOf_LIGHT(onFace.view, window.upper);
    // Rounding may move a ray to a neighbouring texel.
    window.texels = windowOf_LIGHT(min(a, b) - 0.01, max(a, b) + 0.01);
  }
  return window;
}

// Estimate the largest separation of casters at least as far along a face's axis as a depth of its
// map.
//
// That depth alone gives a bound, which is tight if the light lies across the axis. Elsewhere
// heights over the light's plane tell more. The caster's height is taken in the middle of where it
// is seen, so the result is no bound. The least height would bound it. But that is often nearly 0,
// so searches would grow too wide to find casters near the receiver.
// @param slope the middle of where they are seen
float separationEstimate_LIGHT(
  ViewPoint onFace, ViewPoint point, SeenLight_LIGHT light, vec2 slope, float depth)
{
  float nearest = distanceOf_LIGHT(onFace, depth);
  // The way to the light's farthest point along the axis.
  vec3 first = onFace_LIGHT(point, onFace.face, light.axes[0]);
  vec3 second = onFace_LIGHT(point, onFace.face, light.axes[1]);
  float before = nearest - extentAlong_LIGHT(vec2(first.z, second.z));
  float behind = max(onFace.position.z - nearest, 0.0);
  float bound = behind < light.most * before ? behind / before : light.most;
  // Heights of the receiver and the caster over the light's plane.
  vec3 normal = onFace_LIGHT(point, onFace.face, light.normal);
  float height = dot(normal, onFace.position);
  float heightCaster = nearest * dot(normal, vec3(slope, 1.0));
  float share = max(height / heightCaster, 0.0); // 0 if the light's plane is between them
  return heightCaster == 0.0 ? bound : clamp(share - 1.0, 0.0, bound);
}

// As above, for all casters in the pyramid's blocks that cover a window.
float separationEstimate_LIGHT(
  ViewPoint onFace, ViewPoint point, SeenLight_LIGHT light, FaceWindow_LIGHT window)
{
  float largest = 0.0;
  int level = window.texels.level;
  ivec2 last = window.texels.last >> level;
  for (int y = window.texels.first.y >> level; y <= last.y; ++y)
  {
    for (int x = window.texels.first.x >> level; x <= last.x; ++x)
    {
      float nearest = texelFetch(depthBounds_LIGHT, ivec3(x, y, onFace.view), level - 1).r;
      if (nearest < 1.0)
      {
        vec2 a = acrossOf_LIGHT(onFace.view, vec2(ivec2(x, y) << level));
        vec2 b = acrossOf_LIGHT(onFace.view, vec2((ivec2(x, y) + 1) << level));
        vec2 lower = clamp(min(a, b), window.lower, window.upper);
        vec2 upper = clamp(max(a, b), window.lower, window.upper);
        vec2 slope = 0.5 * (lower + upper);
        largest = max(largest, separationEstimate_LIGHT(onFace, point, light, slope, nearest));
      }
    }
  }
  return largest;
}

// Estimate the largest separation of a caster within the light's reach at that separation. Each
// step searches a smaller area.
float largestSeparation_LIGHT(ViewPoint point, SeenLight_LIGHT light)
{
  float separation = light.most;
  for (int i = 0; i < 4; ++i)
  {
    float largest = 0.0;
    for (int face = 0; face < 6; ++face)
    {
      ViewPoint onFace = onFace_LIGHT(point, face);
      if (onFace.view < 0)
      {
        continue;
      }
      FaceWindow_LIGHT window = windowOn_LIGHT(onFace, point, light, separation);
      largest =
        window.any ? max(largest, separationEstimate_LIGHT(onFace, point, light, window)) : largest;
    }
    separation = min(separation, largest);
  }
  return separation;
}

// Return how many texels away the receiver's plane is evaluated at a separation.
float texelsAcross_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation)
{
  FaceWindow_LIGHT window = windowOn_LIGHT(point, point, light, separation);
  vec2 texels = abs(viewTexels_LIGHT[point.view].xy) * (window.upper - window.lower);
  return 0.5 * max(texels.x, texels.y);
}

// Decide all lookups at a separation by the map's bounds: 1 lit, 0 hidden, -1 undecided.
float decidedWithin_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation, float slack)
{
  bool lit = true;
  bool hidden = true;
  for (int face = 0; face < 6; ++face)
  {
    ViewPoint onFace = onFace_LIGHT(point, face);
    FaceWindow_LIGHT window = windowOn_LIGHT(onFace, point, light, separation);
    if (!window.any)
    {
      continue;
    }
    float decided = onFace.view < 0
      ? 1.0
      : decided_LIGHT(onFace, window.texels, window.own, slackOn_LIGHT(onFace, point, slack));
    lit = lit && decided == 1.0;
    hidden = hidden && decided == 0.0;
    if (!lit && !hidden)
    {
      return -1.0;
    }
  }
  return lit ? 1.0 : 0.0;
}

// Return the least separation of casters, if the map's bounds decide that all lookups are hidden.
float leastSeparation_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation)
{
  float least = light.most;
  for (int face = 0; face < 6; ++face)
  {
    ViewPoint onFace = onFace_LIGHT(point, face);
    if (onFace.view < 0)
    {
      continue;
    }
    FaceWindow_LIGHT window = windowOn_LIGHT(onFace, point, light, separation);
    if (window.any)
    {
      float farthest = distanceOf_LIGHT(onFace, boundsOf_LIGHT(onFace, window.texels).y);
      least = min(least, window.own.x / farthest - 1.0);
    }
  }
  return least;
}

// Spread a point of the light's shape for the search, and return its weight: the share of the area
// around it. Points are denser in the middle, where low casters are found. All angles get equally
// many, and so do casters at all distances between light and receiver.
// @param place on return, relative to the largest separation
float spreadForSearch_LIGHT(inout vec2 place, SeenLight_LIGHT light, ViewPoint point, float largest)
{
  float widest =
    largest * max(length(light.axes[0]), length(light.axes[1])) / length(point.position);
  float angle = atan(widest);
  float share = extentOf_LIGHT(place); // points were spread by the square root of their extent
  float extent = share * share;
  float tangent = tan(extent * angle);
  float spread = widest > 1e-3 ? tangent / widest : extent;
  float density = widest > 1e-3 ? angle * (1.0 + tangent * tangent) / widest : 1.0;
  place *= share > 0.0 ? spread / share : 0.0;
  return 2.0 * spread * density;
}
