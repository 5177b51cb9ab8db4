// Draws a level of the pyramid of depth bounds: the least and the largest depth of 2 x 2 texels of
// the map, or of 2 x 2 blocks of the level below. Texels beyond the map are empty.

uniform sampler2DArray depthMap;
uniform sampler2DArray bounds;
uniform int level;
uniform int layer;

out vec2 depthBounds;

vec2 boundsOf(ivec2 place)
{
  if (level > 0)
  {
    return texelFetch(bounds, ivec3(place, layer), level - 1).rg;
  }
  bool onMap = all(lessThan(place, textureSize(depthMap, 0).xy));
  return vec2(onMap ? texelFetch(depthMap, ivec3(place, layer), 0).r : 1.0);
}

void main()
{
  ivec2 first = 2 * ivec2(gl_FragCoord.xy);
  depthBounds = boundsOf(first);
  for (int i = 1; i < 4; ++i)
  {
    vec2 other = boundsOf(first + ivec2(i & 1, i >> 1));
    depthBounds = vec2(min(depthBounds.x, other.x), max(depthBounds.y, other.y));
  }
}
