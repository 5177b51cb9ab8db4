// Gathers where rings cover texels that their middles touch, row by row (drawRing() of
// TexelCells.h).

#include "shadowtech/exact/texel_shapes.glsl"
#include "shadowtech/exact/texel_cells.glsl"
#include "shadowtech/exact/walk_rows.glsl"

// A ring's polygons, the middle first, and the edges around it.
struct RingRecord
{
  uint firstPolygon, polygonCount;
  uint firstSegment, segmentCount;
};

layout(std430, binding = 5) readonly buffer Rings { RingRecord rings[]; };

int lastRowOf(uint shape)
{
  return polygons[rings[shape].firstPolygon].lastRow;
}

bool meets(SegmentRecord border, int x, int y)
{
  if (y < border.firstRow || y > border.lastRow)
  {
    return false;
  }
  Part part = Part(0.0lf, 1.0lf);
  return keepRow(part, border, y) && isIn(columnsOf(border, part), x) &&
    keepColumn(part, border, x);
}

void walkRow(uint shape, int y)
{
  RingRecord ring = rings[shape];
  Span touched = rowOf(polygons[ring.firstPolygon], y).touched;
  for (int x = touched.first; x <= touched.last; ++x)
  {
    bool goesOn = true;
    for (uint i = 0u; goesOn && i < ring.segmentCount; ++i)
    {
      goesOn = !meets(segments[ring.firstSegment + i], x, y);
    }
    if (!goesOn)
    {
      continue;
    }
    float farthest = -infinity;
    for (uint i = 0u; i < ring.polygonCount; ++i)
    {
      PolygonRecord member = polygons[ring.firstPolygon + i];
      Row row = rowOf(member, y);
      if (isIn(row.touched, x))
      {
        farthest = max(farthest, farthestOf(member, depthAt(member, row, x)));
      }
    }
    lower(cellAt(x, y) + containedInCell, farthest);
  }
}
