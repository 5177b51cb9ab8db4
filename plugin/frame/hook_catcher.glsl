// The look of shadow catchers (vtkGnomonPropKeys::SHADOW_CATCHER).

uniform int gnomonCatches; // 1: this prop shows nothing but shadows

// Return black, as opaque as the share of light that casters keep from a fragment.
// @param lit, unshadowed the fragment's colours, with a gamma as their exponent's inverse
vec4 gnomonCaught(vec4 lit, vec4 unshadowed, float gamma)
{
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  float whole = dot(pow(max(unshadowed.rgb, 0.0), vec3(gamma)), luminance);
  float arrived = dot(pow(max(lit.rgb, 0.0), vec3(gamma)), luminance);
  return vec4(vec3(0.0), whole > arrived ? lit.a * (1.0 - arrived / whole) : 0.0);
}
