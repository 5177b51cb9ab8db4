// The colours of the light's points, and the visibility that follows from them.

#include "shadowtech/base/share.glsl"
#include "shadowtech/base/shine.glsl"

#ifdef TEXTURED

uniform usampler2D lightTexture;
// From offsets to the light's centre to the texture, whose x and y span [-1, 1].
uniform mat3 pictureFromView;
uniform vec3 lit; // the texture's mean

// The twin of PlacedTexture::colourAt().
Shine shineAt(vec3 offset)
{
  vec2 place = (pictureFromView * offset).xy;
  ivec2 size = textureSize(lightTexture, 0);
  ivec2 texel = clamp(ivec2((0.5 * place + 0.5) * vec2(size)), ivec2(0), size - 1);
  return vec3(texelFetch(lightTexture, texel, 0).rgb);
}

// Return visibility from colours. The colours of a few points seldom have the texture's mean, so
// they are scaled to it. Unhidden receivers then get the mean, without noise. Opposite points may
// be brighter than those they replace, so the result is limited to 1.
// @param seen sum over the points that are seen
// @param all sum over all of the pixel's points
Shine visibilityOf(Shine seen, Shine all)
{
  vec3 scaled = lit * mix(seen / max(all, 1.0), vec3(1.0), equal(seen, all));
  vec3 plain = seen / float(255 * RAYS * RAYS); // for channels that are 0 in all points
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
  return shareOf(seen, float(RAYS * RAYS));
}

#endif
