// A corner of what is drawn in a polygon's place (shapeAround()).

layout(location = 0) in vec2 placeClip;

void main()
{
  gl_Position = vec4(placeClip, 0.0, 1.0);
}
