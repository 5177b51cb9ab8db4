// What a triangle gives to the minima of a texel; blending takes them.

uniform float size;

flat in Cover cover;

layout(location = 0) out vec2 bounds;

void main()
{
  bounds = boundsIn(cover, gl_FragCoord.xy - 0.5 * size);
}
