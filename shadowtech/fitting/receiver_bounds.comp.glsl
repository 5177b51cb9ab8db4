// Finds the bounds of the receivers that the camera sees, in each of a light's views: x and y in
// texels of the map before the fit, z the distance along the view. With DISTANCES, the box after
// these gets the distance from the camera.
//
// A group of invocations goes along a few rows of pixels, side by side, so that it reads memory in
// order. Each invocation adds its bounds to the boxes at the end. Nearly all receivers lie inside
// of the bounds found before them. So an invocation first skips such pixels, a few neighbours at a
// time, which share reads of the uniforms. Only a pixel outside of the bounds is tested fully.
// These are loops, not branches, because software OpenGL executes all of a branch, taken or not.

#include "shadowtech/fitting/bounds_buffer.glsl"
#include "shadowtech/fitting/receivers.glsl"
#include "shadowtech/fitting/splits.glsl"

layout(local_size_x = GROUP) in;

uniform vec2 coveredTexels; // only receivers between these, before the fit, can be shadowed
#if VIEWS_SPLITS_LIGHT
uniform float splitLambda;
#endif

#ifdef DISTANCES
const int firstBox = VIEWS_LIGHT;
const int boxes = 1;
#else
const int firstBox = 0;
const int boxes = VIEWS_LIGHT;
#endif

// A point's place on the map of the view that may see it, in texels before the fit; z: the distance
// along the view.
struct Place
{
  int view;
  vec3 place;
};

bool findPlace(vec3 positionLight, out Place place)
{
  ViewPoint entered;
  bool found = enterView_LIGHT(positionLight, vec3(0.0), entered);
  int view = max(entered.view, 0); // without a view any value will do, if it is a valid index
  vec2 texel = texelBeforeFit_LIGHT(view, acrossOf_LIGHT(entered.position));
  place = Place(view, vec3(texel, entered.position.z));
  return found;
}

// True if a pixel's receiver counts: the light reaches it, and a caster may shadow it.
bool counts(ivec2 pixel, vec4 point)
{
  Place found;
  return isReached(pixel, point) && findPlace(lightFromView(point.xyz), found) &&
    isFinite(found.place) && all(greaterThanEqual(found.place.xy, coveredTexels.xx)) &&
    all(lessThanEqual(found.place.xy, coveredTexels.yy));
}

#ifdef DISTANCES

void beginBoxes() {}
// Return the box that a pixel would grow by `value`, if it counts; -1: none.
int valueOf(vec4 point, out vec3 value)
{
  value = vec3(-point.z);
  return 0;
}

#else

#if VIEWS_SPLITS_LIGHT

float splits[VIEWS_LIGHT];

void beginBoxes()
{
  float nearest = lowerOf(VIEWS_LIGHT).z;
  float farthest = upperOf(VIEWS_LIGHT).z;
  for (int i = 0; i < VIEWS_LIGHT; ++i)
  {
    splits[i] = splitDistance(nearest, farthest, float(i) / float(VIEWS_LIGHT), splitLambda);
  }
}
int boxOf(Place place, float distanceCamera)
{
  int box = 0;
  for (int i = 1; i < VIEWS_LIGHT; ++i)
  {
    box += distanceCamera >= splits[i] ? 1 : 0;
  }
  return box;
}

#else

void beginBoxes() {}
int boxOf(Place place, float distanceCamera)
{
  return place.view;
}

#endif

// Return the box that a pixel would grow by `value`, if it counts; -1: none.
int valueOf(vec4 point, out vec3 value)
{
  Place place;
  bool found = findPlace(lightFromView(point.xyz), place);
  value = place.place;
  return found ? boxOf(place, -point.z) : -1;
}

#endif

// The bounds that this invocation knows.
vec3 lower[boxes];
vec3 upper[boxes];

// The number of neighbours tested together: every GROUP-th pixel of a row, the last one again
// beyond its end. More neighbours share more reads, but need more registers.
const int together = boxes == 1 ? 8 : 4;
ivec2 neighbour(ivec2 first, int i, int width)
{
  return ivec2(min(first.x + i * GROUP, width - 1), first.y);
}

// True if any neighbour would grow its box, if it counts. NaN does not.
bool anyGrows(ivec2 first, int width)
{
  bool result = false;
  for (int i = 0; i < together; ++i)
  {
    vec4 point = texelFetch(receiverPoints, neighbour(first, i, width), 0);
    vec3 value;
    int box = valueOf(point, value);
    // The cleared value marks pixels where nothing was drawn: no receiver lies at the eye.
    box = point.xyz == vec3(0.0) ? -1 : box;
    for (int other = 0; other < boxes; ++other)
    {
      bool grows = any(lessThan(value, lower[other])) || any(greaterThan(value, upper[other]));
      result = result || (box == other && grows);
    }
  }
  return result;
}

void addThoseThatCount(ivec2 first, int width)
{
  for (int i = 0; i < together; ++i)
  {
    ivec2 pixel = neighbour(first, i, width);
    vec4 point = texelFetch(receiverPoints, pixel, 0);
    vec3 value;
    int box = counts(pixel, point) ? valueOf(point, value) : -1;
    for (int other = 0; other < boxes; ++other)
    {
      lower[other] = box == other ? min(lower[other], value) : lower[other];
      upper[other] = box == other ? max(upper[other], value) : upper[other];
    }
  }
}

// Return the next neighbours, in this row or the one after it.
ivec2 next(ivec2 first, int width)
{
  first.x += GROUP * together;
  return first.x < width ? first : ivec2(gl_LocalInvocationID.x, first.y + 1);
}

void main()
{
  ivec2 size = textureSize(receiverPoints, 0);
  ivec2 first = ivec2(gl_LocalInvocationID.x, int(gl_WorkGroupID.x) * ROWS);
  int end = min(first.y + ROWS, size.y);
  beginBoxes();
  // Start from the bounds that other invocations have found.
  for (int box = 0; box < boxes; ++box)
  {
    lower[box] = lowerOf(firstBox + box);
    upper[box] = upperOf(firstBox + box);
  }
  while (first.y < end)
  {
    for (;;)
    {
      if (anyGrows(first, size.x))
      {
        break;
      }
      first = next(first, size.x);
      if (first.y >= end)
      {
        break;
      }
    }
    addThoseThatCount(ivec2(first.x, min(first.y, end - 1)), size.x); // at the end, some again
    first = next(first, size.x);
  }
  for (int box = 0; box < boxes; ++box)
  {
    if (lower[box].x <= upper[box].x)
    {
      growBox(firstBox + box, lower[box], upper[box]);
    }
  }
}
