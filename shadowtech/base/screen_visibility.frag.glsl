// The image route of a pointwise technique: calls its visibility function for the receiver of every
// pixel. The technique's own source stands in front of this one, numbered for light 0. With CLASSES
// the shader also writes each pixel's class.

uniform sampler2D receiverFragments; // x: > 0 if it receives; zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates

layout(location = 0) out float visibility;
#ifdef CLASSES
layout(location = 1) out uint pixelClass; // an index into TechniqueInfo::classes
#endif

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 fragment = texelFetch(receiverFragments, pixel, 0);
  if (fragment.x <= 0.0)
  {
    visibility = 1.0;
#ifdef CLASSES
    pixelClass = 0u; // no receiver
#endif
    return;
  }
  vec4 point = texelFetch(receiverPoints, pixel, 0);
  visibility = visibility_0(point.xyz, vec3(fragment.zw, point.w));
#ifdef CLASSES
  pixelClass = uint(pixelClass_0);
#endif
}
