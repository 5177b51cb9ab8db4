// The type of a light's factor at a point of its area, and of sums of it: 1, or for a light with a
// texture the texel's colour in 255ths (LightTexture.h).

#ifdef TEXTURED
#define Shine vec3
#else
#define Shine float
#endif
