// A Gaussian over the pixels around one along a row or a column, of those that show the same
// surface (Curtis 2009, section 3, whose weights know depth alone), and whose visibility is the
// same as far as the rays tell: the edge between those that were blocked and those that were not,
// and how far off it is, say which way visibility changes and over what length (Mehta, Wang and
// Ramamoorthi 2012 take such lengths for the filter's width). So penumbrae keep their width, and
// noise is taken off along them as far as the filter goes. Where rays tell nothing, as all or none
// are blocked, visibility may differ by no more than their noise makes it. The first of the two
// passes goes along rows.
//
// What is turned away from the light is left as it is and gives nothing to others. A pixel with
// none in its square that rays have decided keeps its visibility bit for bit.

#include "shadowtech/montecarlo/classes.glsl"

uniform sampler2D receiverFragments; // x: > 0 if it receives; zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates
uniform sampler2D unfiltered;        // x: visibility, y: class
uniform sampler2D source;            // x: visibility, y: the greatest class in the row: the first pass' result
uniform sampler2D slopes;            // xyz: visibility's gradient, 0 where rays tell none; then the mean in the row
uniform ivec2 axis;                  // of the pass
uniform float lit;                   // the visibility of what nothing hides the light from
uniform vec2 pixelSide;              // a pixel's side is x + y * distance

layout(location = 0) out vec2 filtered;
layout(location = 1) out vec3 slopeOfRow;

#define SIGMA_PIXELS max(0.5 * float(FILTER_PIXELS), 0.5) // the Gaussian's deviation
// The same as a share of a penumbra's width. The squared deviation of a ramp is width^2 / 12, and
// so the filter widens it by sqrt(1 + 12 * 0.09^2): by less than 5 %.
#define SIGMA_WIDTHS 0.09

// How far two visibilities are apart, squared, in deviations of what counts as noise: sqrt(6) times
// what RAYS x RAYS jittered rays err by. Squared, that is v (1 - v) / RAYS^3 where a line across
// the light leaves a share v of it: 1 / 6 RAYS^3 on the mean over v, and nothing where it leaves
// all of the light or nothing. So in the middle of a penumbra three times the mean noise counts.
float squaredDeviations(float a, float b)
{
  float v = 0.5 * (a + b) / lit;
  float apart = (a - b) / lit;
  float noise = 6.0 * v * (1.0 - v) / float(RAYS * RAYS * RAYS);
  return apart * apart / max(noise, 1e-6); // where both have all or nothing, they are not apart
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
      continue; // a row's greatest class is its pixel's own where that is turned away
    }
    vec4 otherPoint = texelFetch(receiverPoints, other, 0);
    vec3 otherNormal = vec3(texelFetch(receiverFragments, other, 0).zw, otherPoint.w);
    vec3 way = otherPoint.xyz - point.xyz;
    // How many pixels the other point lies off the plane of this one: 0 all over a plane, however
    // it is seen.
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
  slopeOfRow = slopeSum / max(slopeWeights, 1e-30); // 0 where none in the row tells one
  bool keeps = axis.y == 1 && greatestClass < BY_RAYS;
  filtered = vec2(keeps ? original.x : sum / weights, greatestClass);
}
