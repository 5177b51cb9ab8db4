// Draws polygons into cells, row by row.

#include "shadowtech/conservative/draw_polygon.glsl"
#include "shadowtech/conservative/walk_rows.glsl"

int lastRowOf(uint shape)
{
  return polygons[shape].lastRow;
}

void walkRow(uint shape, int y)
{
  PolygonRecord polygon = polygons[shape];
  Row row = rowOf(polygon, y);
  for (int x = row.touched.first; x <= row.touched.last; ++x)
  {
    drawTexel(polygon, row, x, y);
  }
}
