// A shape per triangle, from nothing but its number. RECTANGLES: of two triangles; else of one.

flat out Cover cover;

void main()
{
#ifdef RECTANGLES
  const vec2 shares[6] = vec2[](vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, 1.0),
    vec2(1.0, 0.0), vec2(1.0, 1.0));
  cover = coverOfTriangle(uint(gl_VertexID) / 6u);
  Rectangle rectangle = rectangleOf(cover);
  vec2 place = cornerOf(rectangle, shares[gl_VertexID % 6]);
#else
  cover = coverOfTriangle(uint(gl_VertexID) / 3u);
  vec2 place = wideCorner(cover, gl_VertexID % 3);
#endif
  gl_Position = isEmpty(boxOf(cover)) ? nowhere : deviceOf(place);
}
