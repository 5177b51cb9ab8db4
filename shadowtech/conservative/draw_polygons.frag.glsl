// Draws a polygon into the cell of a texel that it may touch.

#include "shadowtech/conservative/draw_polygon.glsl"

void main()
{
  PolygonRecord polygon = polygons[gl_PrimitiveID];
  ivec2 texel = ivec2(gl_FragCoord.xy) + ivec2(0, firstRow);
  if (texel.y >= polygon.firstRow && texel.y <= polygon.lastRow)
  {
    Row row = rowOf(polygon, texel.y);
    if (isIn(row.touched, texel.x))
    {
      drawTexel(polygon, row, texel.x, texel.y);
    }
  }
}
