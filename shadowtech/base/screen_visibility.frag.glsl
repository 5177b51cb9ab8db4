// The image route of a pointwise technique: its visibility function, called for the receiver of every
// pixel. The technique's own file stands in front of this one, numbered for light 0.

uniform sampler2D receiverPositions; // xyz: view coordinates
uniform sampler2D receiverSurfaces;  // x: > 0 if it receives; yzw: geometric normal in view coordinates

out float visibility;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(receiverSurfaces, pixel, 0);
  if (surface.x <= 0.0)
  {
    visibility = 1.0;
    return;
  }
  visibility = visibility_0(texelFetch(receiverPositions, pixel, 0).xyz, surface.yzw);
}
