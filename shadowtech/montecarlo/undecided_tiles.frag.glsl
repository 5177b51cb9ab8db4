// Summarizes each tile (UndecidedTiles.h).

#include "shadowtech/montecarlo/classes.glsl"

uniform sampler2D visibilityAndClass;

// x: the greatest class; y, z: the least and the greatest visibility of receivers that face the
// light
out vec3 tile;

void main()
{
  ivec2 lower = TILE_PIXELS * ivec2(gl_FragCoord.xy);
  ivec2 upper = min(lower + TILE_PIXELS, textureSize(visibilityAndClass, 0));
  tile = vec3(0.0, 1.0, 0.0);
  for (int y = lower.y; y < upper.y; ++y)
  {
    for (int x = lower.x; x < upper.x; ++x)
    {
      vec2 pixel = texelFetch(visibilityAndClass, ivec2(x, y), 0).xy;
      bool counts = pixel.y >= LIT;
      tile.x = max(tile.x, pixel.y);
      tile.y = counts ? min(tile.y, pixel.x) : tile.y;
      tile.z = counts ? max(tile.z, pixel.x) : tile.z;
    }
  }
}
