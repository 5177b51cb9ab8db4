// What the points of the light shine with, and what visibility follows from it.

#include "shadowtech/base/shine.glsl"

#ifdef TEXTURED

uniform usampler2D lightTexture;
uniform mat3 pictureFromView; // takes offsets from the light's centre to the texture, whose x and y go from -1 to 1
uniform vec3 lit;             // the texture's mean

// The twin of PlacedTexture::colourAt().
Shine shineAt(vec3 offset)
{
  vec2 place = (pictureFromView * offset).xy;
  ivec2 size = textureSize(lightTexture, 0);
  ivec2 texel = clamp(ivec2((0.5 * place + 0.5) * vec2(size)), ivec2(0), size - 1);
  return vec3(texelFetch(lightTexture, texel, 0).rgb);
}

// A few points seldom have the texture's mean: their colours are scaled so that they do. Of what
// nothing hides the light from, visibility is the mean then, without noise. Points that gave way to
// brighter ones may come to more than all of the light.
// @param seen sum over the points that are seen
// @param all sum over all of the pixel's points
Shine visibilityOf(Shine seen, Shine all)
{
  vec3 scaled = lit * (seen / max(all, 1.0));
  vec3 plain = seen / float(255 * RAYS * RAYS); // of a channel that none of them has
  return min(mix(plain, scaled, greaterThan(all, vec3(0.0))), 1.0);
}

#else

const float lit = 1.0;

Shine shineAt(vec3 offset)
{
  return 1.0;
}

Shine visibilityOf(Shine seen, Shine all)
{
  return seen / float(RAYS * RAYS);
}

#endif
