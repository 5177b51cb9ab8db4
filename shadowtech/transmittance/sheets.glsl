// The share of a light that sheets leave at a point (SheetMap). SHEET_GRIDS_LIGHT,
// SHEET_LAMP_LIGHT as 1 for positional lights, SHEET_DEPTHS_LIGHT layers of crossings' places,
// SHEET_SHARE_LIGHT as a share's type, and SHEET_COLOURED_LIGHT as 1 if it is a colour come first.

uniform sampler2DArray sheets_LIGHT;
uniform mat4 sheetFromView_LIGHT[SHEET_GRIDS_LIGHT]; // to the light's own coordinates
uniform vec3 sheetLower_LIGHT[SHEET_GRIDS_LIGHT];    // a grid's box
uniform vec3 sheetExtent_LIGHT[SHEET_GRIDS_LIGHT];

// Return what is left of a texel's ray at a depth.
// @param place the texel and its grid's first layer
SHEET_SHARE_LIGHT leftOfTexel_LIGHT(ivec3 place, float depth)
{
  int before = 0;
  for (int i = 0; i < SHEET_DEPTHS_LIGHT; ++i)
  {
    vec4 crossings = texelFetch(sheets_LIGHT, place + ivec3(0, 0, i), 0);
    before += int(dot(vec4(lessThan(crossings, vec4(depth))), vec4(1.0)));
  }
  int last = max(before - 1, 0);
  ivec3 layer = place + ivec3(0, 0, SHEET_DEPTHS_LIGHT + last / 4);
  SHEET_SHARE_LIGHT left = SHEET_SHARE_LIGHT(texelFetch(sheets_LIGHT, layer, 0)[last % 4]);
#if SHEET_COLOURED_LIGHT == 1
  const ivec3 channel = ivec3(0, 0, SHEET_DEPTHS_LIGHT);
  left.g = texelFetch(sheets_LIGHT, layer + channel, 0)[last % 4];
  left.b = texelFetch(sheets_LIGHT, layer + 2 * channel, 0)[last % 4];
#endif
  return before > 0 ? left : SHEET_SHARE_LIGHT(1.0);
}

SHEET_SHARE_LIGHT gnomonSheets_LIGHT(vec3 positionView, vec3 normalView)
{
  const float steepest = 0.125; // cosine of a plane against the ray
  vec2 points = vec2(textureSize(sheets_LIGHT, 0).xy);
  int layers = textureSize(sheets_LIGHT, 0).z / SHEET_GRIDS_LIGHT;
  SHEET_SHARE_LIGHT left = SHEET_SHARE_LIGHT(1.0);
  for (int i = 0; i < SHEET_GRIDS_LIGHT; ++i)
  {
    vec3 at = (sheetFromView_LIGHT[i] * vec4(positionView, 1.0)).xyz;
    float scale = SHEET_LAMP_LIGHT == 1 ? at.z : 1.0; // lengths by the grid's sides
    vec3 ray = SHEET_LAMP_LIGHT == 1 ? at / at.z : vec3(0.0, 0.0, 1.0);
    at.xy /= scale;
    vec3 share = (at - sheetLower_LIGHT[i]) / sheetExtent_LIGHT[i];
    if (share.z > 0.0 && share == clamp(share, vec3(0.0), vec3(1.0, 1.0, share.z)))
    {
      vec3 normal = normalize(mat3(sheetFromView_LIGHT[i]) * normalView);
      float along = dot(normal, ray);
      float least = steepest * length(ray);
      along = along < 0.0 ? min(along, -least) : max(along, least);
      vec2 texel = sheetExtent_LIGHT[i].xy / (points - 1.0);
      float slack = 0.25 * max(texel.x, texel.y) * scale * dot(ray, ray) / (along * along);
      vec2 place = share.xy * (points - 1.0);
      vec2 low = min(floor(place), points - 2.0);
      left = SHEET_SHARE_LIGHT(0.0);
      for (int corner = 0; corner < 4; ++corner)
      {
        vec2 of = low + vec2(corner & 1, corner >> 1);
        float rise = -scale * dot(normal.xy, (of - place) * texel) / along;
        vec2 weights = 1.0 - abs(of - place);
        left += weights.x * weights.y * leftOfTexel_LIGHT(ivec3(ivec2(of), layers * i),
          min(share.z + (rise - slack) / sheetExtent_LIGHT[i].z - 2.0 / 65535.0, 1.0));
      }
    }
  }
  return left;
}
