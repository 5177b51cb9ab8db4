// The pass's additions to the declarations of VTK's fragment shaders (GLSL 1.50). On the inline
// route the lights' techniques follow, with their functions visibility_N. On the others
// hook_receiver.glsl follows, and on the image route hook_image.glsl.

uniform int gnomonReceives;    // 0: this prop shows no shadows
uniform int gnomonTranslucent; // 1: in no layer: translucent, or (image route) seen through
uniform float gnomonFacetHeight; // most height of curved surfaces above the prop's facets

uniform vec4 gnomonEye; // where the lines of sight meet (CameraView::eyeView())
#if VTK_VIEW_IS_RIGID
vec3 gnomonInView(vec3 positionVtkView) { return positionVtkView; }
vec3 gnomonNormalInView(vec3 normalVtkView) { return normalVtkView; }
#else
uniform mat4 gnomonViewFromVtkView; // to rigid coordinates in the scene's unit
uniform mat3 gnomonNormalFromVtkView;

vec3 gnomonInView(vec3 positionVtkView)
{
  return (gnomonViewFromVtkView * vec4(positionVtkView, 1.0)).xyz;
}

vec3 gnomonNormalInView(vec3 normalVtkView)
{
  return gnomonNormalFromVtkView * normalVtkView;
}
#endif

vec3 gnomonToCamera(vec3 positionView)
{
  return gnomonEye.xyz - gnomonEye.w * positionView;
}

// Return the geometric normal of the triangle under this fragment, on the side that the camera
// sees. Must be called in uniform control flow. If the position is constant over the quad (a
// triangle seen exactly edge-on) there is no plane, and the result is the direction to the camera.
vec3 gnomonFaceNormal(vec3 positionView)
{
  vec3 toCamera = gnomonToCamera(positionView);
  vec3 normal = cross(dFdx(positionView), dFdy(positionView));
  normal = dot(normal, normal) > 0.0 ? normal : toCamera;
  normal *= inversesqrt(dot(normal, normal));
  return dot(normal, toCamera) < 0.0 ? -normal : normal;
}
