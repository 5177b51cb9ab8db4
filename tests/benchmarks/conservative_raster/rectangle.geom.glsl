// A rectangle per triangle.

layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;

in vec4 onMap[];
flat out Cover cover;

void main()
{
  Cover found = coverOf(onMap[0], onMap[1], onMap[2]);
  Rectangle rectangle = rectangleOf(found);
  if (isEmpty(rectangle))
  {
    return;
  }
  for (int i = 0; i < 4; ++i)
  {
    cover = found;
    gl_Position = deviceOf(cornerOf(rectangle, vec2(i & 1, i >> 1)));
    EmitVertex();
  }
  EndPrimitive();
}
