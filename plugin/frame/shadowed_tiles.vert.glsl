// Tiles of a picture (DeferredPicture.h), given by their corners in pixels.

layout(location = 0) in vec2 corner;

uniform ivec2 size; // of the picture

void main()
{
  gl_Position = vec4(2.0 * corner / vec2(size) - 1.0, 0.0, 1.0);
}
