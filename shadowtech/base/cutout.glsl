// Holes of a caster's texture, when casters are drawn (CasterDrawing.h). Without CUTOUT there are
// none.

#ifdef CUTOUT

in vec2 cutoutCoordinates;

uniform sampler2D cutoutMask; // 0 where the caster has a hole, as the alpha that VTK looks at

// At the end of a shader that takes derivatives.
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
