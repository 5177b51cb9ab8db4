// Applies a Gaussian along a row or a column, over pixels of the same surface whose visibility is
// the same as far as the rays tell. The first of the two passes goes along rows. Curtis 2009,
// section 3, weighs depth alone.
//
// Blocked and free rays tell the edge between them and its distance. These give the direction in
// which visibility changes, and over what length (Mehta, Wang and Ramamoorthi 2012 use such lengths
// as the filter's width). So penumbrae keep their width, and the filter removes noise along them.
// Where all or no rays are blocked, visibility may differ by no more than noise.
//
// Receivers turned away from the light stay as they are and do not contribute. A pixel keeps its
// visibility bit for bit if rays decided no pixel in its square.

#include "shadowtech/base/share.glsl"
#include "shadowtech/montecarlo/classes.glsl"

uniform sampler2D receiverFragments; // x: > 0 if it receives; zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates
uniform sampler2D unfiltered;        // x: visibility, y: class
// x: visibility, y: the greatest class in the row, as results of the first pass.
uniform sampler2D source;
// xyz: visibility's gradient, 0 where rays tell none. The second pass reads its mean in the row.
uniform sampler2D slopes;
uniform ivec2 axis;     // direction of the pass
uniform float lit;      // the visibility of unhidden receivers
uniform vec2 pixelSide; // a pixel's side is x + y * distance

layout(location = 0) out vec2 filtered;
layout(location = 1) out vec3 slopeOfRow;

#define SIGMA_PIXELS max(0.5 * float(FILTER_PIXELS), 0.5) // the Gaussian's deviation
// The same as a share of a penumbra's width. The squared deviation of a ramp is width^2 / 12. So
// the filter widens it by sqrt(1 + 12 * 0.09^2), which is less than 5 %.
#define SIGMA_WIDTHS 0.09

// Return the squared distance of two visibilities in deviations of noise, which are sqrt(6) times
// the error of RAYS x RAYS jittered rays.
//
// If a line across the light leaves a share v of it, that error squared is v (1 - v) / RAYS^3. Its
// mean over v is 1 / (6 RAYS^3); at v = 0 and v = 1 it is 0. So three times the mean noise counts
// in the middle of a penumbra.
float squaredDeviations(float a, float b)
{
  float v = 0.5 * (a + b) / lit;
  float apart = (a - b) / lit;
  float noise = 6.0 * v * (1.0 - v) / float(RAYS * RAYS * RAYS);
  return apart * apart / max(noise, 1e-6); // 0 where both see all or nothing
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 size = textureSize(source, 0);
  vec2 original = texelFetch(unfiltered, pixel, 0).xy;
  if (original.y < LIT)
  {
    filtered = original;
    slopeOfRow = vec3(0.0);
    return;
  }
  vec4 point = texelFetch(receiverPoints, pixel, 0);
  vec3 normal = vec3(texelFetch(receiverFragments, pixel, 0).zw, point.w);
  float footprint = pixelSide.x + pixelSide.y * -point.z;

  float here = texelFetch(source, pixel, 0).x;
  float sum = 0.0;
  float weights = 0.0;
  float greatestClass = 0.0;
  vec3 slope = texelFetch(slopes, pixel, 0).xyz;
  vec3 slopeSum = vec3(0.0);
  float slopeWeights = 0.0;
  for (int i = -FILTER_PIXELS; i <= FILTER_PIXELS; ++i)
  {
    ivec2 other = pixel + i * axis;
    if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, size)))
    {
      continue;
    }
    vec2 visibility = texelFetch(source, other, 0).xy;
    if (visibility.y < LIT)
    {
      continue; // a row's greatest class is the pixel's own if that is turned away
    }
    vec4 otherPoint = texelFetch(receiverPoints, other, 0);
    vec3 otherNormal = vec3(texelFetch(receiverFragments, other, 0).zw, otherPoint.w);
    vec3 way = otherPoint.xyz - point.xyz;
    // Distance of the other point from this one's plane, in pixels. It is 0 all over a plane,
    // however that is seen.
    float off = abs(dot(normal, way)) / footprint;
    float alike = max(dot(normal, otherNormal), 0.0);
    float alike4 = alike * alike * alike * alike;
    float steps = float(i) / SIGMA_PIXELS;
    float sameSurface = exp(-0.5 * steps * steps) * alike4 * alike4 / (1.0 + off);
    vec3 otherSlope = texelFetch(slopes, other, 0).xyz;
    float widths = max(abs(dot(slope, way)), abs(dot(otherSlope, way))) / SIGMA_WIDTHS;
    float apart = squaredDeviations(visibility.x, here);
    float weight = i == 0 ? 1.0 : sameSurface * exp(-0.5 * (widths * widths + apart));
    sum += weight * visibility.x;
    weights += weight;
    greatestClass = max(greatestClass, visibility.y);
    float tells = otherSlope == vec3(0.0) ? 0.0 : sameSurface;
    slopeSum += tells * otherSlope;
    slopeWeights += tells;
  }
  slopeOfRow = slopeSum / max(slopeWeights, 1e-30); // 0 if no pixel in the row tells one
  bool keeps = axis.y == 1 && greatestClass < BY_RAYS;
  filtered = vec2(keeps ? original.x : shareOf(sum, weights), greatestClass);
}
