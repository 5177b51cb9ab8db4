// Hands fragments two numbers: the drawn surface's (-1 if the snapshot does not hold it), and that
// of the instance's first primitive, as gl_PrimitiveID counts within an instance. If a uniform of
// the fragment shader differs from prop to prop, llvmpipe copies 33 kB in each draw.

uniform int gnomonDrawn;
uniform int gnomonPrimitivesPerInstance; // 0 if the surface is not drawn as instances

flat out ivec2 gnomonDrawnVSOutput;

void main()
{
  gnomonMain();
  gnomonDrawnVSOutput = ivec2(gnomonDrawn, gl_InstanceID * gnomonPrimitivesPerInstance);
}
