// Holes that a caster's texture cuts, for shaders that draw casters (CasterDrawing.h). Without
// CUTOUT there are none.

#ifdef CUTOUT

in vec2 cutoutCoordinates;

uniform sampler2D cutoutMask; // 0 in the caster's holes, like the alpha that VTK tests

// To be called at the end of a shader, because discarding makes derivatives undefined.
void discardHoles()
{
  if (texture(cutoutMask, cutoutCoordinates).r <= 0.0)
  {
    discard;
  }
}

#else

void discardHoles() {}

#endif
