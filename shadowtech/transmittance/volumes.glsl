// The share of a light that volumes leave at a point (VolumeStack): slices of grids in the light's
// space, one grid after the other. VOLUME_GRIDS_LIGHT, and VOLUME_LAMP_LIGHT as 1 for positional
// lights, come first.

uniform sampler2DArray volumes_LIGHT;
uniform mat4 volumeFromView_LIGHT[VOLUME_GRIDS_LIGHT]; // to the light's own coordinates
uniform vec3 volumeLower_LIGHT[VOLUME_GRIDS_LIGHT];    // a grid's box
uniform vec3 volumeExtent_LIGHT[VOLUME_GRIDS_LIGHT];
uniform vec2 volumeSlices_LIGHT[VOLUME_GRIDS_LIGHT]; // its first slice, and its last one

float gnomonVolumes_LIGHT(vec3 positionView, vec3 normalView)
{
  vec2 points = vec2(textureSize(volumes_LIGHT, 0).xy);
  float left = 1.0;
  for (int i = 0; i < VOLUME_GRIDS_LIGHT; ++i)
  {
    vec3 at = (volumeFromView_LIGHT[i] * vec4(positionView, 1.0)).xyz;
    at.xy /= VOLUME_LAMP_LIGHT == 1 ? at.z : 1.0;
    vec3 share = (at - volumeLower_LIGHT[i]) / volumeExtent_LIGHT[i];
    if (share.z > 0.0 && share == clamp(share, vec3(0.0), vec3(1.0, 1.0, share.z)))
    {
      vec2 texel = (share.xy * (points - 1.0) + 0.5) / points;
      float slice = mix(volumeSlices_LIGHT[i].x, volumeSlices_LIGHT[i].y, min(share.z, 1.0));
      float before = floor(slice);
      float behind = min(before + 1.0, volumeSlices_LIGHT[i].y);
      left = mix(textureLod(volumes_LIGHT, vec3(texel, before), 0.0).r,
        textureLod(volumes_LIGHT, vec3(texel, behind), 0.0).r, slice - before);
    }
  }
  return left;
}
