// Computes the share of an area light that each pixel's receiver sees: the mean over rays to points
// of the light, traced through the light's map (Curtis 2009). The pixel's class follows it
// (MonteCarlo::info()). With DECIDES no ray is traced, and pixels that need rays become SEARCHED.

#include "shadowtech/base/light_reach.glsl"
#include "shadowtech/montecarlo/classes.glsl"
#include "shadowtech/montecarlo/light_points.glsl"
#include "shadowtech/montecarlo/light_shine.glsl"

uniform sampler2D receiverFragments; // x: > 0 if it receives; zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates
uniform vec4 lightView;              // (position of the centre, 1), or (unit vector towards it, 0)
uniform vec2 pixelSide;              // a pixel's side is x + y * distance
uniform int viewCount;               // of the light's map; 0 if there is no caster
uniform mat4 rayFromView[VIEWS];     // from the camera's view coordinates to ray space (RaySpace.h)
uniform mat4 viewFromRay[VIEWS];

#include "shadowtech/montecarlo/slab_search.glsl"

#ifdef TEXTURED
#define VisibilityAndClass vec4
#else
#define VisibilityAndClass vec2
#endif
layout(location = 0) out VisibilityAndClass visibilityAndClass;
// slopeOf() if some rays are blocked, but not all; else 0.
layout(location = 1) out vec3 visibilitySlope;
// The same visibility for the light's layers.
layout(location = 2) out float layer;
#ifdef TEXTURED
layout(location = 3) out float layerGreen;
layout(location = 4) out float layerBlue;
#endif

struct Receiver
{
  vec3 position;
  vec3 normal;
  float offset; // how far above the surface rays begin to count, in world units
  int view;     // the first view whose map shows it; negative if none does
  float own;    // rise of its own surface above its plane in its texel, as Place::plane measures
};

// The part of a ray on a view's map, in ray space.
struct Segment
{
  vec3 begin; // at the receiver
  vec3 end;   // at the light
  bool any;
};

// A receiver in a view's ray space.
struct Place
{
  vec4 at;
  // The receiver's plane. Its product with (u, v, p, 1) is the signed distance in the world over w.
  vec4 plane;
};
Place placeOf(Receiver receiver, int view)
{
  vec4 plane = vec4(receiver.normal, -dot(receiver.normal, receiver.position));
  return Place(rayFromView[view] * vec4(receiver.position, 1.0), plane * viewFromRay[view]);
}

// Find how far the receiver's own surface rises in its texel. Where surfaces bend, another triangle
// may be in the texel's centre, whose depth is that of the whole texel. It may lie above the
// receiver's plane there.
//
// Slabs that begin less than a quarter of a texel above the plane count as the same surface.
// Surfaces that bend up by 27 degrees do so within half a texel. Without this, smooth meshes with
// triangles of a texel's size have dark pixels.
void findOwnSurface(inout Receiver receiver)
{
  for (int view = 0; view < viewCount && receiver.view < 0; ++view)
  {
    Place place = placeOf(receiver, view);
    vec2 texel = floor(place.at.xy / place.at.w);
    if (place.at.w <= 0.0 || any(lessThan(texel, vec2(0.0))) ||
      any(greaterThanEqual(texel, vec2(mapSide))))
    {
      continue;
    }
    receiver.view = view;
    vec3 along = viewFromRay[view][0].xyz;
    vec3 across = viewFromRay[view][1].xyz;
    float most = 0.25 * min(sqrt(dot(along, along)), sqrt(dot(across, across)));
    for (int i = 0; i < PAGES; ++i)
    {
      vec4 page = texelFetch(slabs, ivec3(texel, view * PAGES + i), 0);
      vec2 above = vec2(dot(place.plane, vec4(texel + 0.5, page.x, 1.0)),
        dot(place.plane, vec4(texel + 0.5, page.z, 1.0)));
      receiver.own = max(receiver.own, above.x < most ? above.x : 0.0);
      receiver.own = max(receiver.own, above.y < most ? above.y : 0.0);
    }
  }
}

// Clip the range in which position + t * way is on the positive side of a plane.
void cut(inout vec2 range, float position, float way)
{
  float t = -position / way;
  range.x = way > 0.0 ? max(range.x, t) : range.x;
  range.y = way < 0.0 ? min(range.y, t) : range.y;
  range.y = way == 0.0 && position < 0.0 ? -1.0 : range.y; // along the plane, on its negative side
}

// Return the part of a ray on a view's map.
// @param place the receiver's in the view
// @param depths of the map between which there may be slabs
// @param cutAtBorders true to clip at the map's borders, too
Segment onMap(int view, Receiver receiver, Place place, vec3 way, float length, vec2 depths,
  bool cutAtBorders)
{
  vec4 at = place.at;
  vec4 plane = place.plane;
  vec4 by = rayFromView[view] * vec4(way, 0.0);
  float rising = dot(receiver.normal, way); // > 0 if the receiver faces the ray's direction
  vec2 range = vec2(receiver.offset / rising, length);
  // Rounding must not end a ray just before slabs at those depths. The tolerance is 2^-18, for
  // parallel rays of their range [0, 1].
  vec2 beyond = 3.8146973e-6 * max(abs(depths), vec2(1.0 - lightView.w));
  depths += vec2(-beyond.x, beyond.y);
  cut(range, at.z - depths.x * at.w, by.z - depths.x * by.w);
  cut(range, depths.y * at.w - at.z, depths.y * by.w - by.z);
  if (cutAtBorders)
  {
    cut(range, at.x, by.x);
    cut(range, at.y, by.y);
    cut(range, float(mapSide) * at.w - at.x, float(mapSide) * by.w - by.x);
    cut(range, float(mapSide) * at.w - at.y, float(mapSide) * by.w - by.y);
  }
  Segment segment = Segment(vec3(0.0), vec3(0.0), range.x < range.y);
  if (!segment.any)
  {
    return segment;
  }
  vec4 begin = at + range.x * by;
  vec4 end = at + range.y * by;
  segment.begin = begin.xyz / begin.w;
  segment.end = end.xyz / end.w;

  // The map may hold the receiver itself, with one depth for the whole texel. Half a texel off,
  // that depth differs from the receiver's plane, or from a surface that bends up from it. Rays
  // count from where they are that far before the plane. Rounding is added, also of triangles'
  // corners, which are rasterized to 1/256 of a texel.
  float rounding = 7.6293945e-6 * max(abs(segment.begin.z), abs(segment.end.z)); // 2^-17
  float limit = 0.51 * (abs(plane.x) + abs(plane.y)) + rounding * abs(plane.z) +
    (view == receiver.view ? receiver.own : 0.0);
  vec2 before = rising * range / vec2(begin.w, end.w);
  if (before.y <= limit)
  {
    segment.any = false;
  }
  else if (before.x < limit)
  {
    segment.begin =
      mix(segment.begin, segment.end, (limit - before.x) / (before.y - before.x));
  }
  return segment;
}

// Return a point of the light in front of the receiver's plane: the given one or the opposite. The
// twin of sideOfSample() in ShadowRay.h.
vec3 inFront(Receiver receiver, vec3 toCentre, vec3 offset)
{
  return facesLight(receiver.normal, toCentre + offset) ? offset : -offset;
}

// Return where rays to the light end, in lengths of their way.
float lengthOfRays(Receiver receiver)
{
#if defined(BOX)
  // The box's near face.
  return (lightFromView * vec4(receiver.position, 1.0)).z;
#else
  return lightView.w > 0.0 ? 1.0 : 1e30;
#endif
}

vec2 depthsOf(int view)
{
  return boundsOfCell(view, ivec2(0), topLevel).xy;
}

#ifdef CLASSIFY_PIXELS
#define REGIONS 4 // how often the region is narrowed at most

// Return a corner of a box around the light, relative to its centre.
vec3 cornerOfLight(int i)
{
  vec3 corner = 2.0 * vec3(i & 1, (i >> 1) & 1, i >> 2) - 1.0;
  corner.z = SHAPE == BALL ? corner.z : 0.0;
  return viewFromUnit * corner;
}

// True if no slab of some texels rises above the receiver's plane to where rays begin to count
// (onMap()). A slab is highest where it begins, at the texel's corner.
bool liesBelow(Receiver receiver, vec4 plane, ivec2 lower, ivec2 upper, float deepest)
{
  if (plane.z >= 0.0)
  {
    return false; // the plane does not face the map's eye
  }
  // Half of onMap()'s rounding is left as room for the rounding of both.
  float highest = 0.01 * (abs(plane.x) + abs(plane.y)) - 3.8146973e-6 * deepest * plane.z +
    receiver.own;
  for (int y = lower.y; y <= upper.y; ++y)
  {
    for (int x = lower.x; x <= upper.x; ++x)
    {
      float begins = boundsOfCell(0, ivec2(x, y), 0).x;
      if (begins <= 1.0 && dot(plane, vec4(vec2(x, y) + 0.5, begins, 1.0)) > highest)
      {
        return false;
      }
    }
  }
  return true;
}

// Classify all rays of a pixel by the region of the map that they can meet.
//
// All rays lie between those to the corners of a box around the light. So do their parts behind the
// depth where the first slab begins (Curtis 2009, section 3.6, which states this for square
// lights). A region whose slabs begin deeper shrinks. Where nothing is in front of a surface, each
// region is a fraction of the last one. In the end only the receiver's own texels are left, which
// are tested one by one.
// @param depths of the map; on return, of the region
// @return LIT, UMBRA or SEARCHED
float classOf(Receiver receiver, Place place, vec3 toCentre, inout vec2 depths)
{
  const int corners = SHAPE == BALL ? 8 : 4;
  vec3 begin[corners];
  vec3 way[corners];               // from `begin` to the light's end
  vec2 begins = vec2(1e30, -1e30); // the least and the greatest depth at the receiver's end
  bool blockable = true;           // true if all of them have a counting part on the map
  for (int i = 0; i < corners; ++i)
  {
    vec3 corner = cornerOfLight(i);
    if (!facesLight(receiver.normal, toCentre + corner))
    {
      return SEARCHED; // part of the light is behind the receiver's plane
    }
    Segment segment = onMap(
      0, receiver, place, toCentre + corner, lengthOfRays(receiver), vec2(depths.x, 2.0), false);
    blockable = blockable && segment.any;
    begin[i] = segment.any ? segment.begin : place.at.xyz / place.at.w;
    way[i] = segment.any ? segment.end - segment.begin : vec3(0.0);
    begins = vec2(min(begins.x, begin[i].z), max(begins.y, begin[i].z));
  }
  if (viewCount == 0)
  {
    return LIT;
  }
  float last = float(mapSide - 1);
  vec2 lower;
  vec2 upper;
  for (int iteration = 0; iteration < REGIONS; ++iteration)
  {
    lower = vec2(1e30);
    upper = vec2(-1e30);
    float ends = -1e30; // the greatest depth at the light's end
    for (int i = 0; i < corners; ++i)
    {
      // Towards the light depths fall or stay.
      float part = way[i].z < 0.0 ? clamp((depths.x - begin[i].z) / way[i].z, 0.0, 1.0) : 1.0;
      vec3 end = begin[i] + part * way[i];
      lower = min(lower, min(begin[i].xy, end.xy));
      upper = max(upper, max(begin[i].xy, end.xy));
      ends = max(ends, end.z);
    }
    // Rounding may move a point to a neighbouring texel.
    lower = floor(lower - 0.01);
    upper = floor(upper + 0.01);
    if (any(greaterThan(lower, vec2(last))) || any(lessThan(upper, vec2(0.0))))
    {
      return LIT;
    }
    bool inside = all(greaterThanEqual(lower, vec2(0.0))) && all(lessThanEqual(upper, vec2(last)));
    lower = max(lower, vec2(0.0));
    upper = min(upper, vec2(last));
    vec4 bounds = boundsOfRegion(0, ivec2(lower), ivec2(upper));
    if (begins.y < bounds.x)
    {
      return LIT;
    }
#ifndef EYE_LAYER
    // One depth lies inside a slab of every texel.
    if (blockable && inside && bounds.z <= min(begins.x, bounds.w) && ends <= bounds.z)
    {
      return UMBRA;
    }
#endif
    bool isSame = bounds.x <= depths.x;
    depths = vec2(max(depths.x, bounds.x), min(depths.y, bounds.y));
    if (isSame)
    {
      break;
    }
  }
  bool asked = all(lessThan(upper - lower, vec2(4.0))) &&
    liesBelow(receiver, place.plane, ivec2(lower), ivec2(upper), max(abs(begins.x), abs(begins.y)));
  return asked ? LIT : SEARCHED;
}
#endif

#ifdef CLASSIFY_RAYS
// Classify a single ray in the same way.
// @param where for UMBRA, the point in a slab that is nearest to the receiver as far as known: 0 at
// the receiver, 1 at the light
float classOf(int view, Segment segment, out float where)
{
  where = 0.0;
  vec2 last = vec2(float(mapSide - 1));
  vec2 lower = clamp(floor(min(segment.begin.xy, segment.end.xy) - 0.01), vec2(0.0), last);
  vec2 upper = clamp(floor(max(segment.begin.xy, segment.end.xy) + 0.01), vec2(0.0), last);
  vec4 bounds = boundsOfRegion(view, ivec2(lower), ivec2(upper));
  float least = min(segment.begin.z, segment.end.z);
  float greatest = max(segment.begin.z, segment.end.z);
  if (greatest < bounds.x || bounds.y < least)
  {
    return LIT;
  }
#ifndef EYE_LAYER
  float deepest = min(greatest, bounds.w); // inside a slab of every texel
  if (bounds.z <= deepest && least <= bounds.z)
  {
    float span = segment.end.z - segment.begin.z;
    // A ray across the light has one depth.
    where = span != 0.0 ? clamp((deepest - segment.begin.z) / span, 0.0, 1.0) : 0.0;
    return UMBRA;
  }
#endif
  return SEARCHED;
}
#endif

// Return where a point of a view's map lies on a ray, in lengths of its way.
float lengthTo(int view, Receiver receiver, vec3 way, vec3 point)
{
  vec4 place = viewFromRay[view] * vec4(point, 1.0);
  return max(dot(place.xyz / place.w - receiver.position, way), 0.0) / dot(way, way);
}

// Trace a ray through all views; true if one of them blocks it.
// @param first the receiver's place in the first view
// @param depths between which there may be slabs, for a single view
// @param searched set to true if the ray needed a search
// @param at where it is blocked, in lengths of its way
bool isBlocked(Receiver receiver, Place first, vec3 way, float length, vec2 depths,
  inout bool searched, out float at)
{
  at = 0.0;
  for (int view = 0; view < viewCount; ++view)
  {
    Place place = first;
#if VIEWS > 1
    place = placeOf(receiver, view);
#endif
    Segment segment =
      onMap(view, receiver, place, way, length, VIEWS == 1 ? depths : depthsOf(view), true);
    if (!segment.any)
    {
      continue;
    }
    float where;
#ifdef CLASSIFY_RAYS
    float rayClass = classOf(view, segment, where);
    if (rayClass == UMBRA)
    {
      at = lengthTo(view, receiver, way, mix(segment.begin, segment.end, where));
      return true;
    }
    if (rayClass == LIT)
    {
      continue;
    }
#endif
    searched = true;
    if (meetsSlabs(view, segment.begin, segment.end, where))
    {
      at = lengthTo(view, receiver, way, mix(segment.begin, segment.end, where));
      return true;
    }
  }
  return false;
}

// Return the gradient of visibility around a receiver in the penumbra of an edge, in view
// coordinates. While the receiver crosses the penumbra, the edge crosses the light.
// @param across from the middle of the light's hidden part to that of its seen part
// @param at where the edge is, in lengths of the way to the light
vec3 slopeOf(vec3 toCentre, vec3 across, float at, float footprint)
{
  // Project across the receiver's view of the light.
  vec3 ray = normalize(toCentre);
  across -= dot(across, ray) * ray;
  float apart = length(across);
  if (apart == 0.0)
  {
    return vec3(0.0); // the edge's direction is unknown
  }
  vec3 direction = across / apart;
  vec3 extents = abs(direction * viewFromUnit);
#if SHAPE == RECTANGLE
  float side = 2.0 * (extents.x + extents.y);
#elif SHAPE == DISK
  float side = 2.0 * length(extents.xy);
#else
  float side = 2.0 * length(extents);
#endif
  // Rays to a lamp meet in the receiver. For a sun, `at` is a length.
  float width = side * (lightView.w > 0.0 ? at / max(1.0 - at, 1e-6) : at);
  return direction / max(width, 1e-6 * footprint); // edges that touch the receiver have no penumbra
}

void answer(Shine visibility, float pixelClass)
{
  visibilityAndClass = VisibilityAndClass(visibility, pixelClass);
#ifdef TEXTURED
  layer = visibility.r;
  layerGreen = visibility.g;
  layerBlue = visibility.b;
#else
  layer = visibility;
#endif
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  visibilitySlope = vec3(0.0);
  vec4 fragment = texelFetch(receiverFragments, pixel, 0);
  if (fragment.x <= 0.0)
  {
    answer(lit, NO_RECEIVER);
    return;
  }
  vec4 point = texelFetch(receiverPoints, pixel, 0);
  Receiver receiver = Receiver(point.xyz, vec3(fragment.zw, point.w), 0.0, -1, 0.0);
  float footprint = pixelSide.x + pixelSide.y * -point.z;
  receiver.offset = shadowRayOffset(2.3841858e-7 * length(point.xyz), footprint); // 2^-22
  vec3 toCentre = lightView.xyz - lightView.w * receiver.position;
  if (!facesLight(receiver.normal, toCentre) || !lightReaches(receiver.position))
  {
    answer(Shine(0.0), TURNED_AWAY);
    return;
  }

  findOwnSurface(receiver);
  Place place = placeOf(receiver, 0); // unused if there is no view
  vec2 depths = viewCount > 0 ? depthsOf(0) : vec2(0.0);
#ifdef CLASSIFY_PIXELS
  float pixelClass = classOf(receiver, place, toCentre, depths);
  if (pixelClass != SEARCHED)
  {
    answer(pixelClass == LIT ? lit : Shine(0.0), pixelClass);
    return;
  }
#endif
#ifdef DECIDES
  answer(lit, SEARCHED);
#else

  Shine seen = Shine(0.0);
  Shine all = Shine(0.0);
  bool searched = false;
  float blocked = 0.0;           // number of rays
  float blockedAt = 0.0;         // sum, in lengths of their ways
  vec3 hiddenPoints = vec3(0.0); // sum
  vec3 seenPoints = vec3(0.0);   // sum
  for (int first = 0; first < RAYS * RAYS; first += 4)
  {
    FourPoints points = fourPoints(pixel, first);
    for (int i = first; i < min(first + 4, RAYS * RAYS); ++i)
    {
      vec3 offset = lightPoint(points, i);
      all += shineAt(offset);
      offset = inFront(receiver, toCentre, offset);
      float at;
      if (isBlocked(
            receiver, place, toCentre + offset, lengthOfRays(receiver), depths, searched, at))
      {
        blocked += 1.0;
        blockedAt += at;
        hiddenPoints += offset;
      }
      else
      {
        seen += shineAt(offset);
        seenPoints += offset;
      }
    }
  }
  float free = float(RAYS * RAYS) - blocked;
  if (blocked > 0.0 && free > 0.0)
  {
    vec3 across = seenPoints / free - hiddenPoints / blocked;
    visibilitySlope = slopeOf(toCentre, across, blockedAt / blocked, footprint);
  }
  answer(visibilityOf(seen, all), searched ? SEARCHED : BY_RAYS);
#endif
}
