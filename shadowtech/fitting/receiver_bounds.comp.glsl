// The bounds of the receivers that the camera sees, in each of a light's views: x and y in texels of the
// map before the fit, z the distance along the view. With DISTANCES: the box after them holds the
// distance from the camera.
//
// A group of invocations goes along a few rows of pixels, side by side, so that what is read lies side by
// side; each adds what it found to the boxes at the end.

#include "shadowtech/base/light_views.glsl"
#include "shadowtech/fitting/bounds_buffer.glsl"
#include "shadowtech/fitting/splits.glsl"

layout(local_size_x = GROUP) in;

uniform sampler2D receiverFragments; // x: > 0 if it receives; zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates
uniform vec2 coveredTexels; // receivers between these, before the fit, may be shadowed at all
#if VIEWS_SPLITS_LIGHT
uniform float splitLambda;
#endif

const float infinity = uintBitsToFloat(0x7f800000u);

#ifdef DISTANCES
const int firstBox = VIEWS_LIGHT;
const int boxes = 1;
#else
const int firstBox = 0;
const int boxes = VIEWS_LIGHT;
#endif

// Written so that what is not a number fails.
bool isFinite(vec3 v)
{
  return all(lessThan(abs(v), vec3(infinity)));
}

// A receiver that counts.
struct Counted
{
  int view;
  vec3 place; // on the view's map, in texels before the fit; z: the distance along the view
  float distanceCamera;
};

// Returns false for pixels that do not count: background, what shows no shadows, what the light does not
// reach, or no caster can shadow, and what is not finite.
bool findCounted(ivec2 pixel, out Counted counted)
{
  counted = Counted(0, vec3(0.0), 0.0);
  vec4 fragment = texelFetch(receiverFragments, pixel, 0);
  if (!(fragment.x > 0.0))
  {
    return false;
  }
  vec4 point = texelFetch(receiverPoints, pixel, 0);
  vec3 normal = vec3(fragment.zw, point.w);
  if (!isFinite(point.xyz) || !isFinite(normal))
  {
    return false;
  }
  vec3 p = (lightFromView_LIGHT * vec4(point.xyz, 1.0)).xyz;
  vec3 n = mat3(lightFromView_LIGHT) * normal;
  ViewPoint entered;
  if (!lightReaches_LIGHT(p, n) || !enterView_LIGHT(p, n, entered))
  {
    return false;
  }
  vec2 texel = texelBeforeFit_LIGHT(entered.view, acrossOf_LIGHT(entered.position));
  counted = Counted(entered.view, vec3(texel, entered.position.z), -point.z);
  return isFinite(counted.place) && all(greaterThanEqual(texel, coveredTexels.xx)) &&
    all(lessThanEqual(texel, coveredTexels.yy));
}

#ifdef DISTANCES

void beginBoxes() {}
int boxOf(Counted counted)
{
  return 0;
}
vec3 valueOf(Counted counted)
{
  return vec3(counted.distanceCamera);
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
int boxOf(Counted counted)
{
  int box = 0;
  for (int i = 1; i < VIEWS_LIGHT; ++i)
  {
    box += counted.distanceCamera >= splits[i] ? 1 : 0;
  }
  return box;
}

#else

void beginBoxes() {}
int boxOf(Counted counted)
{
  return counted.view;
}

#endif

vec3 valueOf(Counted counted)
{
  return counted.place;
}

#endif

void main()
{
  ivec2 size = textureSize(receiverFragments, 0);
  int firstRow = int(gl_WorkGroupID.x) * ROWS;
  beginBoxes();
  vec3 lower[boxes];
  vec3 upper[boxes];
  for (int box = 0; box < boxes; ++box)
  {
    lower[box] = vec3(infinity);
    upper[box] = vec3(-infinity);
  }
  for (int y = firstRow; y < min(firstRow + ROWS, size.y); ++y)
  {
    for (int x = int(gl_LocalInvocationID.x); x < size.x; x += GROUP)
    {
      Counted counted;
      if (findCounted(ivec2(x, y), counted))
      {
        int box = boxOf(counted);
        lower[box] = min(lower[box], valueOf(counted));
        upper[box] = max(upper[box], valueOf(counted));
      }
    }
  }
  for (int box = 0; box < boxes; ++box)
  {
    if (lower[box].x <= upper[box].x)
    {
      growBox(firstBox + box, lower[box], upper[box]);
    }
  }
}
