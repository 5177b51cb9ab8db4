// Draws the casters into the map's depth buffer, as the light sees them.

#include "shadowtech/base/occluder_vertex.glsl"

uniform mat4 clipFromCentred;

#ifdef PUSH
// Row of light space's z, scaled to the map's linear depth in [0, 1].
uniform vec4 depthFromCentred;
out float depthLinear;
#endif

void main()
{
  vec3 positionCentred = occluderPositionCentred();
  gl_Position = clipFromCentred * vec4(positionCentred, 1.0);
#ifdef PUSH
  depthLinear = dot(depthFromCentred, vec4(positionCentred, 1.0));
#endif
}
