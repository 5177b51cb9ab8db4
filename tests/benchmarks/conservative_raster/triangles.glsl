// The casters' triangles, fetched.

layout(std430, binding = 0) readonly buffer Positions { float positionsCentred[]; };
layout(std430, binding = 1) readonly buffer Triangles { uint corners[]; };

uniform mat4 mapFromCentred; // to X, Y, Q, W

vec4 cornerOnMap(uint triangle, uint k)
{
  uint at = 3u * corners[3u * triangle + k];
  vec3 position =
    vec3(positionsCentred[at], positionsCentred[at + 1u], positionsCentred[at + 2u]);
  return mapFromCentred * vec4(position, 1.0);
}

Cover coverOfTriangle(uint triangle)
{
  return coverOf(
    cornerOnMap(triangle, 0u), cornerOnMap(triangle, 1u), cornerOnMap(triangle, 2u));
}
