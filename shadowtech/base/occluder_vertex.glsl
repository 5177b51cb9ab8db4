// What OccluderBuffers draws, vertex by vertex.

layout(location = 0) in vec3 positionSource;
// The instance's matrix; the identity, which changes no bit, where a surface is drawn once.
layout(location = 1) in mat4x3 centredFromSource; // and locations 2, 3, 4

vec3 occluderPositionCentred()
{
  return centredFromSource * vec4(positionSource, 1.0);
}
