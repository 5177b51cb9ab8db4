// Projects the casters into a light's map, or as shadows onto a plane (CasterDrawing.h).

#include "shadowtech/base/fit_rows.glsl"

layout(location = 0) in vec3 positionSource;
// The instance's matrix. Surfaces that are drawn once have the identity, which changes no bit.
layout(location = 2) in mat4x3 centredFromSource; // and locations 3, 4, 5

uniform mat4 clipFromCentred;

#ifdef FITTED
uniform sampler2D viewFits;
uniform int view;
#endif

#ifdef DEPTH_LINEAR
// The row of light space's z, scaled to the map's linear depth in [0, 1].
uniform vec4 depthFromCentred;
out float depthLinear;
#endif
#ifdef CLIPS
uniform vec4 keptFromCentred[CLIPS]; // casters count on the positive side of these planes
out float gl_ClipDistance[CLIPS];
#endif

#ifdef CUTOUT
layout(location = 1) in vec2 textureCoordinates;
out vec2 cutoutCoordinates;
#endif

void main()
{
#ifdef CUTOUT
  cutoutCoordinates = textureCoordinates;
#endif
  vec3 positionCentred = centredFromSource * vec4(positionSource, 1.0);
  gl_Position = clipFromCentred * vec4(positionCentred, 1.0);
#ifdef CHOSEN
  gl_Position.xyw = fetchHomography(viewFits, view, WARP_FROM_UNIFORM_ROW) * gl_Position.xyw;
#endif
#ifdef FITTED
  vec4 fit = texelFetch(viewFits, ivec2(view, DEVICE_FIT_ROW), 0);
  gl_Position.xy = fit.xy * gl_Position.xy + fit.zw * gl_Position.w;
#endif
#ifdef DEPTH_LINEAR
  depthLinear = dot(depthFromCentred, vec4(positionCentred, 1.0));
#endif
#ifdef CLIPS
  for (int i = 0; i < CLIPS; ++i)
  {
    gl_ClipDistance[i] = dot(keptFromCentred[i], vec4(positionCentred, 1.0));
  }
#endif
}
