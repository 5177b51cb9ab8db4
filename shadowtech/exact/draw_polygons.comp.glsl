// Rasterizes polygons into cells, row by row (drawPolygon() of TexelCells.h).
// POISON: the polygons leave texels that they touch undecided.
// NOISE: gathers noise after all other passes (drawNoise()).

#include "shadowtech/exact/texel_shapes.glsl"
#include "shadowtech/exact/texel_cells.glsl"
#include "shadowtech/exact/walk_rows.glsl"

void drawTexel(PolygonRecord polygon, Row row, int x, int y)
{
  uint cell = cellAt(x, y);
#ifdef POISON
  lower(cell + nearestInCell, -infinity);
  lower(cell + sharpEndInCell, -infinity);
#elif defined(NOISE)
  if (nearestOf(polygon, depthAt(polygon, row, x)) < oneLayerUpTo(cell))
  {
    lower(cell + noiseInCell, -polygon.noise);
  }
#else
  double depth = depthAt(polygon, row, x);
  float nearest = nearestOf(polygon, depth);
  lower(cell + nearestInCell, nearest);
  if (orderedBits(nearest) < cells[cell + sharpEndInCell])
  {
    lower(cell + climbInCell, -polygon.climb);
  }
  if (isIn(row.sampled, x))
  {
    addLayer(cell, atSample(polygon, depth));
  }
  if (polygon.covers != 0u && isIn(row.contained, x))
  {
    lower(cell + containedInCell, farthestOf(polygon, depth));
  }
#endif
}

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
