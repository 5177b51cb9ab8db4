// Places tiles with undecided pixels, and tiles within `reachTiles` of one. MIXED skips tiles near
// which visibility is the same everywhere (UndecidedTiles.h). Each instance is a tile.

#include "shadowtech/montecarlo/classes.glsl"

uniform sampler2D tiles;   // output of undecided_tiles.frag.glsl
uniform ivec2 pictureSize; // in pixels
uniform ivec2 reachTiles;

void main()
{
  ivec2 size = textureSize(tiles, 0);
  ivec2 tile = ivec2(gl_InstanceID % size.x, gl_InstanceID / size.x);
  ivec2 first = max(tile - reachTiles, ivec2(0));
  ivec2 last = min(tile + reachTiles, size - 1);
  vec3 around = vec3(0.0, 1.0, 0.0);
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      vec3 other = texelFetch(tiles, ivec2(x, y), 0).xyz;
      around = vec3(max(around.x, other.x), min(around.y, other.y), max(around.z, other.z));
    }
  }
  bool drawn = around.x >= BY_RAYS;
#ifdef MIXED
  drawn = drawn && around.y < around.z;
#endif
  ivec2 pixel = TILE_PIXELS * (tile + ivec2(gl_VertexID & 1, gl_VertexID >> 1));
  vec2 corner = vec2(min(pixel, pictureSize)) / vec2(pictureSize);
  // All other tiles collapse to a point outside the picture.
  gl_Position = vec4(drawn ? 2.0 * corner - 1.0 : vec2(2.0), 0.0, 1.0);
}
