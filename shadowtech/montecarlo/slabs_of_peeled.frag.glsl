// Writes the slabs of each texel from its peeled surfaces in order. A surface that faces the light
// and the next one, if it faces away, enclose a solid. All other surfaces are sheets, as thick as
// their span.

#include "shadowtech/montecarlo/slabs.glsl"

// X: depth, y: span. The first PEELED layers face the light; as many after them face away.
uniform sampler2DArray layers;

layout(location = 0) out vec4 firstPage;
layout(location = 1) out vec4 secondPage;

// Rounding separates coincident surfaces by this much.
#define ROUNDING 3.8146973e-6 // 2^-18

vec2 surfaceAt(int number, int firstLayer)
{
  return number < PEELED ? texelFetch(layers, ivec3(gl_FragCoord.xy, firstLayer + number), 0).rg
                         : vec2(2.0, 0.0);
}

// Return where a solid ends that begins at a surface facing the light. On slopes, bodies thinner
// than the surface's span would have gaps between texels. Such a body ends where its front surface
// is in the next texel.
float endOfSolid(vec2 front, float back)
{
  float end = max(front.x, back);
  // Has room for rounding, and stays before the depth of empty texels.
  float reach = min(front.x + 1.01 * front.y, 1.0);
  if (reach <= end)
  {
    return end;
  }
  ivec2 last = textureSize(layers, 0).xy - 1;
  for (int i = 0; i < 4; ++i)
  {
    ivec2 beside = (i & 1) == 0 ? ivec2(1 - i, 0) : ivec2(0, 2 - i);
    ivec2 texel = clamp(ivec2(gl_FragCoord.xy) + beside, ivec2(0), last);
    for (int number = 0; number < PEELED; ++number)
    {
      vec2 next = texelFetch(layers, ivec3(texel, number), 0).rg;
      // True if either surface spans to the other.
      bool sameSurface = next.x <= reach && next.x - 1.01 * next.y <= front.x;
      end = sameSurface ? max(end, next.x) : end;
    }
  }
  return end;
}

void main()
{
  const vec2 none = vec2(2.0, -2.0);
  vec2 found[4] = vec2[](none, none, none, none);
  int count = 0;
  int fronts = 0;
  int backs = 0;
  bool open = false; // true if a surface facing the light waits for one that faces away
  vec2 front = vec2(0.0);
  for (int i = 0; i < 2 * PEELED && count < 4; ++i)
  {
    vec2 nextFront = surfaceAt(fronts, 0);
    vec2 nextBack = surfaceAt(backs, PEELED);
    if (min(nextFront.x, nextBack.x) > 1.0)
    {
      break;
    }
    // A body that stands on a ground ends before the ground begins.
    if (nextBack.x <= nextFront.x + (open ? ROUNDING : 0.0))
    {
      ++backs;
      found[count++] =
        vec2(open ? front.x : nextBack.x,
          open ? endOfSolid(front, nextBack.x) : nextBack.x + nextBack.y);
      open = false;
    }
    else
    {
      ++fronts;
      if (open)
      {
        found[count++] = vec2(front.x, front.x + front.y);
      }
      front = nextFront;
      open = true;
    }
  }
  if (open && count < 4)
  {
    found[count++] = vec2(front.x, front.x + front.y);
  }
  firstPage = vec4(1.0, -1.0, 1.0, -1.0) * vec4(found[0], found[1]);
  secondPage = vec4(1.0, -1.0, 1.0, -1.0) * vec4(found[2], found[3]);
}
