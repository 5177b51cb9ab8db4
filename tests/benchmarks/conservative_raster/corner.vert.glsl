// A corner of a triangle, for rectangle.geom.glsl.

layout(location = 0) in vec3 positionCentred;

uniform mat4 mapFromCentred; // to X, Y, Q, W

out vec4 onMap;

void main()
{
  onMap = mapFromCentred * vec4(positionCentred, 1.0);
}
