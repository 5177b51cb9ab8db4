// Transforms a point to a light's views: whether the light reaches it, which view sees it, and its
// place on that view's layer of the map (lights/LightViews.h, LightViewsGlsl.h). Every technique
// with a map starts here.
//
// The light is described by macros when the shader is compiled:
// - VIEWS_SPOT_LIGHT, VIEWS_BOX_LIGHT, VIEWS_PERSPECTIVE_LIGHT: the kind of light, 0 or 1.
// - VIEWS_CUBE_LIGHT, VIEWS_SPLITS_LIGHT (neither: a single view), VIEWS_WARPED_LIGHT: the layout
//   of its views.
// - VIEWS_LIGHT: the largest number of views.
// - VIEWS_BLENDED_LIGHT: splits overlap.
// - VIEWS_PIXELS_LIGHT: points know which area their pixel shows.
// - VIEWS_FITTED_LIGHT: the last fit of the views was found on the GPU, and is read from a texture.
//   Texels "before the fit" belong to the map of all that can be seen.
// - VIEWS_CHOSEN_LIGHT: so was the warp, which lies in the same texture (fit_rows.glsl).
//
// A view's map is a homography of the plane of the light's rays. Points of that plane have across
// coordinates: x and y of parallel rays, slopes of rays from a position (lights/LightRays.h).

#include "shadowtech/base/fit_rows.glsl"
#include "shadowtech/base/kernel_shape.glsl"
#include "shadowtech/base/shadow_ray.glsl"

uniform mat4 lightFromView_LIGHT;           // rigid: the camera's space to the light's
#if VIEWS_FITTED_LIGHT
uniform sampler2D viewFits_LIGHT;
#endif
#if !VIEWS_WARPED_LIGHT
uniform vec4 viewTexels_LIGHT[VIEWS_LIGHT]; // texel = xy * across + zw
#elif !VIEWS_CHOSEN_LIGHT
uniform mat3 texelFromAcross_LIGHT[VIEWS_LIGHT];
uniform mat3 acrossFromTexel_LIGHT[VIEWS_LIGHT];
#endif
#if VIEWS_SPLITS_LIGHT
uniform int viewCount_LIGHT;
uniform float viewBorder_LIGHT; // texels that a split must hold around a point
#endif
uniform vec2 viewDepths_LIGHT[VIEWS_LIGHT]; // depth = x * z + y
uniform float viewSize_LIGHT;               // the map's side in texels; 0 if there is no view
#if VIEWS_SPOT_LIGHT
uniform float lightCone_LIGHT; // squared tangent of half the cone
#endif
#if VIEWS_BOX_LIGHT
uniform vec3 lightBox_LIGHT; // half width, half height, depth
#endif
#if VIEWS_CUBE_LIGHT
uniform int viewOfFace_LIGHT[6]; // -1: it sees no caster
#endif

#ifndef GNOMON_LIGHT_VIEWS
#define GNOMON_LIGHT_VIEWS

struct ViewPoint
{
  vec3 position;
  vec3 normal;
  int face;   // of a cube
  int view;   // the layer of the map
  vec2 texel; // its place there
  float pixelArea; // the surface in the point's pixel, in squared world units
};

// Return the face of the cube around a light that sees a point: the twin of cubeFaceOf().
int cubeFaceOf(vec3 p)
{
  vec3 a = abs(p);
  if (a.x >= a.y && a.x >= a.z)
  {
    return p.x >= 0.0 ? 0 : 1;
  }
  if (a.y >= a.z)
  {
    return p.y >= 0.0 ? 2 : 3;
  }
  return p.z >= 0.0 ? 4 : 5;
}

// Transform a vector from light space to a face's space: the twin of cubeFaceFromLight().
vec3 cubeFaceFromLight(int face, vec3 v)
{
  vec3 along = face < 2 ? v.yzx : face < 4 ? v.zxy : v;
  vec3 against = face < 2 ? vec3(v.zy, -v.x) : face < 4 ? vec3(v.xz, -v.y) : vec3(v.yx, -v.z);
  return (face & 1) == 0 ? along : against;
}

vec3 lightFromCubeFace(int face, vec3 v)
{
  vec3 along = face < 2 ? v.zxy : face < 4 ? v.yzx : v;
  vec3 against = face < 2 ? vec3(-v.z, v.yx) : face < 4 ? vec3(v.x, -v.z, v.y) : vec3(v.yx, -v.z);
  return (face & 1) == 0 ? along : against;
}

#endif

// Return the direction towards the light, of any length.
vec3 toLight_LIGHT(vec3 positionLight)
{
#if VIEWS_PERSPECTIVE_LIGHT
  return -positionLight;
#else
  return vec3(0.0, 0.0, -1.0);
#endif
}

// True if a surface faces the light and lies in its cone or box.
bool lightReaches_LIGHT(vec3 positionLight, vec3 normalLight)
{
  bool reaches = facesLight(normalLight, toLight_LIGHT(positionLight));
#if VIEWS_SPOT_LIGHT
  reaches = reaches && insideCone(-positionLight, vec3(0.0, 0.0, -1.0), lightCone_LIGHT);
#endif
#if VIEWS_BOX_LIGHT
  reaches = reaches && insideBox(positionLight, lightBox_LIGHT);
#endif
  return reaches;
}

#if VIEWS_WARPED_LIGHT
// Return the homography of a view's layer before the fit, and its inverse.
mat3 texelHomography_LIGHT(int view)
{
#if VIEWS_CHOSEN_LIGHT
  return fetchHomography(viewFits_LIGHT, view, TEXEL_FROM_ACROSS_ROW);
#else
  return texelFromAcross_LIGHT[view];
#endif
}
mat3 acrossHomography_LIGHT(int view)
{
#if VIEWS_CHOSEN_LIGHT
  return fetchHomography(viewFits_LIGHT, view, ACROSS_FROM_TEXEL_ROW);
#else
  return acrossFromTexel_LIGHT[view];
#endif
}
#endif

// Transform across coordinates to texels of a view's layer before the fit, and back.
vec2 texelBeforeFit_LIGHT(int view, vec2 across)
{
#if VIEWS_WARPED_LIGHT
  vec3 texel = texelHomography_LIGHT(view) * vec3(across, 1.0);
  // Visible points have w > 0. Points behind the warp's eye are invisible, and placed off any map.
  return texel.z > 0.0 ? texel.xy / texel.z : vec2(-1e30);
#else
  vec4 texels = viewTexels_LIGHT[view];
  return texels.xy * across + texels.zw;
#endif
}
vec2 acrossBeforeFit_LIGHT(int view, vec2 texel)
{
#if VIEWS_WARPED_LIGHT
  vec3 across = acrossHomography_LIGHT(view) * vec3(texel, 1.0);
  return across.xy / across.z; // not 0 on the map
#else
  vec4 texels = viewTexels_LIGHT[view];
  return (texel - texels.zw) / texels.xy;
#endif
}

// Return the last fit of a view: texel = xy * texel before the fit + zw.
vec4 fitOf_LIGHT(int view)
{
#if VIEWS_FITTED_LIGHT
  return texelFetch(viewFits_LIGHT, ivec2(view, TEXEL_FIT_ROW), 0);
#else
  return vec4(1.0, 1.0, 0.0, 0.0);
#endif
}

// Transform across coordinates to texels of a view's layer, and back.
vec2 texelOf_LIGHT(int view, vec2 across)
{
  vec4 fit = fitOf_LIGHT(view);
  return fit.xy * texelBeforeFit_LIGHT(view, across) + fit.zw;
}
vec2 acrossOf_LIGHT(int view, vec2 texel)
{
  vec4 fit = fitOf_LIGHT(view);
  // Not 0 where anything is on the map.
  return acrossBeforeFit_LIGHT(view, (texel - fit.zw) / fit.xy);
}

// Return a point's across coordinates.
vec2 acrossOf_LIGHT(vec3 positionLight)
{
#if VIEWS_PERSPECTIVE_LIGHT
  return positionLight.xy / positionLight.z; // z > 0: the light reaches it
#else
  return positionLight.xy;
#endif
}

// Return the derivative d texel / d across of a view.
mat2 texelJacobian_LIGHT(int view, vec2 across)
{
#if VIEWS_WARPED_LIGHT
  mat2 beforeFit = homographyJacobian(texelHomography_LIGHT(view), across);
#else
  vec4 texels = viewTexels_LIGHT[view];
  mat2 beforeFit = mat2(texels.x, 0.0, 0.0, texels.y);
#endif
  vec4 fit = fitOf_LIGHT(view);
  return mat2(fit.xy * beforeFit[0], fit.xy * beforeFit[1]);
}

#if VIEWS_PIXELS_LIGHT
// Return how many texels a pixel shows of a point's surface. Both the pixel and the map measure the
// surface across their own direction of view. So silhouettes are no exception, although their
// pixels have nothing to do with their neighbours'.
float texelsOfPixel_LIGHT(ViewPoint point)
{
  float texels = abs(determinant(texelJacobian_LIGHT(point.view, acrossOf_LIGHT(point.position))));
#if VIEWS_PERSPECTIVE_LIGHT
  vec3 ray = point.position / point.position.z;
  texels /= point.position.z * point.position.z;
#else
  vec3 ray = vec3(0.0, 0.0, 1.0);
#endif
  return point.pixelArea * texels * abs(dot(ray, normalize(point.normal)));
}
#endif

// True if a view's layer holds a place and a border around it.
bool holds_LIGHT(vec2 texel, float border)
{
  return all(greaterThanEqual(texel, vec2(border))) &&
    all(lessThan(texel, vec2(viewSize_LIGHT - border)));
}

#if VIEWS_CUBE_LIGHT
// Transform a point that the light reaches to the face that sees it, even if that has no view.
ViewPoint onOwnFace_LIGHT(vec3 positionLight, vec3 normalLight)
{
  int face = cubeFaceOf(positionLight);
  return ViewPoint(cubeFaceFromLight(face, positionLight),
    cubeFaceFromLight(face, normalLight), face, viewOfFace_LIGHT[face], vec2(0.0), 0.0);
}
#endif

// Transform a point that the light reaches to the space of the view that may see it. Splits share
// one space. Returns false if there is no view.
bool enterView_LIGHT(vec3 positionLight, vec3 normalLight, out ViewPoint point)
{
#if VIEWS_CUBE_LIGHT
  point = onOwnFace_LIGHT(positionLight, normalLight);
#else
  point = ViewPoint(positionLight, normalLight, 0, 0, vec2(0.0), 0.0);
#endif
  return point.view >= 0;
}

// Find the view of a point that the light reaches. Returns false if no view sees it: then no caster
// can hide the light's centre from it.
bool findView_LIGHT(vec3 positionLight, vec3 normalLight, out ViewPoint point)
{
  if (!enterView_LIGHT(positionLight, normalLight, point))
  {
    return false;
  }
  vec2 across = acrossOf_LIGHT(point.position);
#if VIEWS_SPLITS_LIGHT
  for (int view = 0; view < viewCount_LIGHT - 1; ++view)
  {
    point.view = view;
    point.texel = texelOf_LIGHT(view, across);
    if (holds_LIGHT(point.texel, viewBorder_LIGHT))
    {
      return true;
    }
  }
  point.view = max(viewCount_LIGHT - 1, 0);
#endif
  point.texel = texelOf_LIGHT(point.view, across);
  return holds_LIGHT(point.texel, 0.0);
}

#if VIEWS_CUBE_LIGHT
// Find the face of a point that the light reaches. This is for techniques that look at other points
// of the light than its centre, and so at casters on any face. The point's own face may have no
// casters, or be cut to casters elsewhere on it. The point then lies off its map. If the face has
// no view, texels and depths are those of the first view. Returns false if there are no casters.
bool findFace_LIGHT(vec3 positionLight, vec3 normalLight, out ViewPoint point)
{
  point = onOwnFace_LIGHT(positionLight, normalLight);
  point.view = max(point.view, 0);
  point.texel = texelOf_LIGHT(point.view, acrossOf_LIGHT(point.position));
  return viewSize_LIGHT > 0.0;
}
#endif

#if VIEWS_BLENDED_LIGHT
// Return the share of the next split in a point that a split's view sees, from 0 inside of the
// layer to 1 at its edge. `next` is the point in the next view. Each split extends into the one
// before by the width of the blend, so that the next view sees what lies along the edge.
float blendIntoNext_LIGHT(ViewPoint point, out ViewPoint next)
{
  next = point;
  ++next.view;
  if (next.view >= viewCount_LIGHT)
  {
    return 0.0;
  }
  next.texel = texelOf_LIGHT(next.view, acrossOf_LIGHT(point.position));
  if (!holds_LIGHT(next.texel, viewBorder_LIGHT))
  {
    return 0.0;
  }
  vec2 inside = min(point.texel, viewSize_LIGHT - point.texel) - viewBorder_LIGHT;
  // The border is less than half.
  float width = SPLIT_BLEND_LIGHT * (viewSize_LIGHT - 2.0 * viewBorder_LIGHT);
  return clamp(1.0 - min(inside.x, inside.y) / width, 0.0, 1.0);
}
#endif

// Return the distance from the light of the receiver's plane on the ray through a texel's centre.
// If the plane runs past that ray or away from it, the distance is larger than any other.
float planeDistance_LIGHT(ViewPoint point, vec2 texelCentre)
{
  vec2 centre = acrossOf_LIGHT(point.view, texelCentre);
  vec3 p = point.position;
  vec3 n = point.normal;
#if VIEWS_PERSPECTIVE_LIGHT
  float along = dot(n, vec3(centre, 1.0));
  return along < 0.0 ? dot(n, p) / along : 1e30;
#else
  return p.z - dot(n.xy, centre - p.xy) / n.z; // n.z < 0: the surface faces the light
#endif
}

// Return the map's depth of a distance from the light.
float viewDepth_LIGHT(ViewPoint point, float distanceLight)
{
  vec2 depth = viewDepths_LIGHT[point.view];
  return depth.x * distanceLight + depth.y;
}
