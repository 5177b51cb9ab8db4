// An area light as a receiver sees it from the middle of a cube's faces. What hides the light's
// point L from the receiver at P, both from the light's centre, lies on the way between them, and
// so on the centre's ray through
//     P + L s,   s = |PX| / |XL| for the caster at X:
// from P at the receiver to L at the light. The face is that of this ray, whatever face the
// receiver is on.

struct SeenLight_LIGHT
{
  mat2x3 axes; // of the shape, in the space of the receiver's face
  vec3 normal; // of its plane, of any length
  vec3 facing; // how the axes and the centre face the receiver's plane
  float most;  // the largest separation that the map has texels for
};

// How many texels there have to be between the ray of a separation and the light's rim.
const float texelsToRim_LIGHT = 8.0;

// A ball's outline: the disk across the way from its centre to the receiver, which is the same from
// whatever face that is looked at. Its axes are those of the plane across the face, turned the
// shortest way.
mat2x3 ballAcross_LIGHT(float radius, vec3 position)
{
  vec3 away = normalize(position); // not along -z: it is on the face
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

// A vector of the receiver's face in the space of another one.
vec3 onFace_LIGHT(ViewPoint point, int face, vec3 v)
{
  return face == point.face ? v : cubeFaceFromLight(face, lightFromCubeFace(point.face, v));
}

// The receiver in the space of another face, which need not see it.
ViewPoint onFace_LIGHT(ViewPoint point, int face)
{
  point.position = onFace_LIGHT(point, face, point.position);
  point.normal = onFace_LIGHT(point, face, point.normal);
  point.view = viewOfFace_LIGHT[face];
  point.face = face;
  return point;
}

// How far along a face's axis what is at a depth of its map is from the light.
float distanceOf_LIGHT(ViewPoint onFace, float depth)
{
  vec2 depths = viewDepths_LIGHT[onFace.view];
  return (depth - depths.y) / depths.x;
}

// Faces of larger depths round them less.
float slackOn_LIGHT(ViewPoint onFace, ViewPoint point, float slack)
{
  return slack * max(viewDepths_LIGHT[onFace.view].x / viewDepths_LIGHT[point.view].x, 1.0);
}

// The separation of what hides the point where a point of the light is looked for; -1 where nothing
// does.
// @param beside that point, times the separation that it is looked for at
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
  if (ray.z == 0.0) // its longest coordinate: it ends at the light's centre, which nothing hides
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

// What of a face may be looked up at a separation.
struct FaceWindow_LIGHT
{
  bool any;
  vec2 lower; // slopes
  vec2 upper;
  TexelWindow_LIGHT texels; // where the face has a view
  vec2 own; // the least and the largest distance that a ray has at the receiver
};

// The largest m from -1 to 1 for which x >= m z says the same of the corners, and so of all that
// lies between them.
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
  // The corners of a parallelogram around the shape.
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
    // Rounding may take a ray to the texel beside it.
    window.texels = windowOf_LIGHT(min(a, b) - 0.01, max(a, b) + 0.01);
  }
  return window;
}

// About the largest separation of casters which are no nearer along a face's axis than a depth of
// its map. That depth alone bounds it, tightly where the light stands across the axis. Elsewhere
// the height over the light's plane says more, but that is taken in the middle of where they are
// seen, and so is no bound: the least height would be one, and is next to 0 so often that searches
// grow too wide to find what is near the receiver.
// @param slope the middle of where they are seen
float separationEstimate_LIGHT(
  ViewPoint onFace, ViewPoint point, SeenLight_LIGHT light, vec2 slope, float depth)
{
  float nearest = distanceOf_LIGHT(onFace, depth);
  // On the way to a point of the light that is as far along the axis as any.
  vec3 first = onFace_LIGHT(point, onFace.face, light.axes[0]);
  vec3 second = onFace_LIGHT(point, onFace.face, light.axes[1]);
  float before = nearest - extentAlong_LIGHT(vec2(first.z, second.z));
  float behind = max(onFace.position.z - nearest, 0.0);
  float bound = behind < light.most * before ? behind / before : light.most;
  // The heights of both over the light's plane.
  vec3 normal = onFace_LIGHT(point, onFace.face, light.normal);
  float height = dot(normal, onFace.position);
  float heightCaster = nearest * dot(normal, vec3(slope, 1.0));
  float share = max(height / heightCaster, 0.0); // 0: they are on either side of it
  return heightCaster == 0.0 ? bound : clamp(share - 1.0, 0.0, bound);
}

// The same of all casters in the blocks of the map's pyramid that hold a window.
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

// About the largest separation that a caster has within the light's reach at that separation. What
// the first steps find lies farther around than what the last one needs.
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

// How many texels the receiver's plane is followed at a separation.
float texelsAcross_LIGHT(ViewPoint point, SeenLight_LIGHT light, float separation)
{
  FaceWindow_LIGHT window = windowOn_LIGHT(point, point, light, separation);
  vec2 texels = abs(viewTexels_LIGHT[point.view].xy) * (window.upper - window.lower);
  return 0.5 * max(texels.x, texels.y);
}

// What all say that may be looked up at a separation: 1 lit, 0 hidden, -1 where the map's bounds do
// not tell.
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

// The least separation of casters where the map's bounds call all of that hidden.
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

// How a point of the light's shape is looked for in the search, and how much of the area around it
// that stands for. Points lie denser in the middle, where low casters are found: as many to every
// angle, and so to casters of all distances from the light to the receiver.
// @param place on return, of the largest separation
float spreadForSearch_LIGHT(inout vec2 place, SeenLight_LIGHT light, ViewPoint point, float largest)
{
  float widest = largest * max(length(light.axes[0]), length(light.axes[1])) / length(point.position);
  float angle = atan(widest);
  float share = extentOf_LIGHT(place); // of a point that is out by its square root
  float extent = share * share;
  float tangent = tan(extent * angle);
  float spread = widest > 1e-3 ? tangent / widest : extent;
  float density = widest > 1e-3 ? angle * (1.0 + tangent * tangent) / widest : 1.0;
  place *= share > 0.0 ? spread / share : 0.0;
  return 2.0 * spread * density;
}
