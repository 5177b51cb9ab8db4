// What a point of an area light shines with beside the light's colour, and sums of it: 1, or of a
// light with a texture (TEXTURED) the texel's colour in 255ths (LightTexture.h).

#ifdef TEXTURED
#define Shine vec3
#else
#define Shine float
#endif
