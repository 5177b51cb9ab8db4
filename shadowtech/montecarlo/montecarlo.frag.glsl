// What share of an area light each pixel's receiver sees: the mean over rays to points of the
// light, which are followed through the light's map (Curtis 2009). Behind it the pixel's class
// (MonteCarlo::info()). With DECIDES no ray is followed, and what takes one is SEARCHED.

#include "shadowtech/base/light_reach.glsl"
#include "shadowtech/montecarlo/classes.glsl"
#include "shadowtech/montecarlo/light_points.glsl"
#include "shadowtech/montecarlo/light_shine.glsl"

uniform sampler2D receiverFragments; // x: > 0 if it receives; zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates
uniform vec4 lightView;              // (position of the centre, 1), or (unit vector towards it, 0)
uniform vec2 pixelSide;              // a pixel's side is x + y * distance
uniform int viewCount;               // of the light's map; 0: there is no caster
uniform mat4 rayFromView[VIEWS];     // the camera's view coordinates to ray space (RaySpace.h)
uniform mat4 viewFromRay[VIEWS];

#include "shadowtech/montecarlo/slab_search.glsl"

#ifdef TEXTURED
#define VisibilityAndClass vec4
#else
#define VisibilityAndClass vec2
#endif
layout(location = 0) out VisibilityAndClass visibilityAndClass;
layout(location = 1) out vec3 visibilitySlope; // slopeOf() where some rays are blocked, but not all; else 0
// The same visibility for the light's layers.
layout(location = 2) out float layer;
#ifdef TEXTURED
layout(location = 3) out float layerGreen;
layout(location = 4) out float layerBlue;
#endif

// A receiver of the light.
struct Receiver
{
  vec3 position;
  vec3 normal;
  float offset; // how far above the surface rays begin to count, in world units
  int view;     // the first that has it on its map; negative: none
  float own;    // how far above its plane its texel holds its own surface, as Place::plane measures
};

// The part of a ray that is on a view's map, in ray space.
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
  // Points (u, v, p, 1) are in its plane, above it or below by their product with this, which is
  // their distance in the world over w.
  vec4 plane;
};
Place placeOf(Receiver receiver, int view)
{
  vec4 plane = vec4(receiver.normal, -dot(receiver.normal, receiver.position));
  return Place(rayFromView[view] * vec4(receiver.position, 1.0), plane * viewFromRay[view]);
}

// Where surfaces bend, another triangle may be in the middle of the receiver's texel, whose depth
// is that of the whole texel, and rise above the receiver's plane till there. What begins less than
// a quarter of a texel above the plane counts as the same surface: one that bends up by 27 degrees
// does, within half a texel. Else smooth meshes with triangles of a texel's size have dark pixels.
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

// Cuts the range in which position + t * way is on the positive side of a plane.
void cut(inout vec2 range, float position, float way)
{
  float t = -position / way;
  range.x = way > 0.0 ? max(range.x, t) : range.x;
  range.y = way < 0.0 ? min(range.y, t) : range.y;
  range.y = way == 0.0 && position < 0.0 ? -1.0 : range.y; // along the plane, on its other side
}

// @param place the receiver's in the view
// @param depths of the map, between which there may be slabs
// @param cutAtBorders whether what is beside the map is cut off, too
Segment onMap(int view, Receiver receiver, Place place, vec3 way, float length, vec2 depths,
  bool cutAtBorders)
{
  vec4 at = place.at;
  vec4 plane = place.plane;
  vec4 by = rayFromView[view] * vec4(way, 0.0);
  float rising = dot(receiver.normal, way); // > 0: the receiver faces where the ray goes
  vec2 range = vec2(receiver.offset / rising, length);
  // Rounding must not end a ray just before what lies at those depths: 2^-18, of parallel rays in
  // their range of [0, 1].
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

  // The receiver may itself be in the map, as one depth for all of a texel. Rays count from where
  // they are as far before its plane, or before what bends up from it, as that is off within half a
  // texel, and for rounding: also of the corners of triangles, which are drawn to within 1/256 of a
  // texel.
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

// A point of the light that is behind the receiver's plane gives way to the opposite one: the twin
// of sideOfSample() in ShadowRay.h.
vec3 inFront(Receiver receiver, vec3 toCentre, vec3 offset)
{
  return facesLight(receiver.normal, toCentre + offset) ? offset : -offset;
}

// How far the ray to a point of the light goes, in lengths of its way.
float lengthOfRays(Receiver receiver)
{
#if defined(BOX)
  // To the box's near face.
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
#define REGIONS 4 // how often the region is narrowed, at most

// A corner of a box around the light, from its centre.
vec3 cornerOfLight(int i)
{
  vec3 corner = 2.0 * vec3(i & 1, (i >> 1) & 1, i >> 2) - 1.0;
  corner.z = SHAPE == BALL ? corner.z : 0.0;
  return viewFromUnit * corner;
}

// Whether no slab of some texels rises above the receiver's plane by as much as rays do where they
// begin to count (onMap()). A slab is highest where it begins, at the texel's corner.
bool liesBelow(Receiver receiver, vec4 plane, ivec2 lower, ivec2 upper, float deepest)
{
  if (plane.z >= 0.0)
  {
    return false; // it does not face the map's eye
  }
  // Half of what onMap() takes for rounding is room for the rounding of both.
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

// What all rays of a pixel can meet: they lie between those to the corners of a box around the
// light, and so does their part behind the depth where the first slab begins (Curtis 2009, section
// 3.6, whose region this is for a square light). A region whose slabs begin deeper is smaller.
// Where nothing is in front of a surface, each is a fraction of the one before, down to the
// receiver's own texels, which are asked one by one.
// @param depths of the map; on return, of the region
// @return LIT, UMBRA or SEARCHED
float classOf(Receiver receiver, Place place, vec3 toCentre, inout vec2 depths)
{
  const int corners = SHAPE == BALL ? 8 : 4;
  vec3 begin[corners];
  vec3 way[corners]; // from there to the light's end
  vec2 begins = vec2(1e30, -1e30); // the least and the greatest depth at the receiver's end
  bool blockable = true;           // whether all of them have a part on the map that counts
  for (int i = 0; i < corners; ++i)
  {
    vec3 corner = cornerOfLight(i);
    if (!facesLight(receiver.normal, toCentre + corner))
    {
      return SEARCHED; // some of the light is behind the receiver's plane
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
      // Towards the light depths fall, or do not change.
      float part = way[i].z < 0.0 ? clamp((depths.x - begin[i].z) / way[i].z, 0.0, 1.0) : 1.0;
      vec3 end = begin[i] + part * way[i];
      lower = min(lower, min(begin[i].xy, end.xy));
      upper = max(upper, max(begin[i].xy, end.xy));
      ends = max(ends, end.z);
    }
    // Rounding may take a place to the texel beside it.
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
    // A depth that is inside a slab of every texel.
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
// The same of a single ray.
// @param where it is in a slab if it is UMBRA, as near to the receiver as is known: from 0 there to
// 1
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
  float deepest = min(greatest, bounds.w); // that is inside a slab of every texel
  if (bounds.z <= deepest && least <= bounds.z)
  {
    float span = segment.end.z - segment.begin.z;
    // A ray across the light has one depth all along.
    where = span != 0.0 ? clamp((deepest - segment.begin.z) / span, 0.0, 1.0) : 0.0;
    return UMBRA;
  }
#endif
  return SEARCHED;
}
#endif

// Where a point of a view's map lies on a ray, in lengths of its way.
float lengthTo(int view, Receiver receiver, vec3 way, vec3 point)
{
  vec4 place = viewFromRay[view] * vec4(point, 1.0);
  return max(dot(place.xyz / place.w - receiver.position, way), 0.0) / dot(way, way);
}

// @param first the receiver's place in the first view
// @param depths of a single view, between which there may be slabs
// @param searched becomes true where that took a search
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

// How visibility changes around a receiver in the penumbra of an edge, as its gradient in view
// coordinates: while the receiver goes across the penumbra, the edge goes across the light.
// @param across from the middle of what is hidden of the light to the middle of what is seen
// @param at where the edge is, in lengths of the way to the light
vec3 slopeOf(vec3 toCentre, vec3 across, float at, float footprint)
{
  // As the light is seen from the receiver.
  vec3 ray = normalize(toCentre);
  across -= dot(across, ray) * ray;
  float apart = length(across);
  if (apart == 0.0)
  {
    return vec3(0.0); // the edge may lie any way
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
  // Rays to a lamp meet in the receiver; those to a sun are counted in units of length.
  float width = side * (lightView.w > 0.0 ? at / max(1.0 - at, 1e-6) : at);
  return direction / max(width, 1e-6 * footprint); // what touches the receiver has none
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
  Place place = placeOf(receiver, 0); // of no consequence where there is no view
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
  float blocked = 0.0;           // rays
  float blockedAt = 0.0;         // sum, in lengths of their ways
  vec3 hiddenPoints = vec3(0.0); // sum
  vec3 seenPoints = vec3(0.0);   // likewise
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
