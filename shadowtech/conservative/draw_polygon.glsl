// What a polygon gives to a texel that it touches (drawPolygon() of TexelCells.h). POISON: it spoils it. NOISE: what it gives when
// all else is drawn (drawNoise()).

#include "shadowtech/conservative/texel_shapes.glsl"
#include "shadowtech/conservative/texel_cells.glsl"

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
