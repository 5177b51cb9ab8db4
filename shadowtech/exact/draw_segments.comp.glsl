// Rasterizes edges into cells, row by row (drawSegment() of TexelCells.h).

#include "shadowtech/exact/texel_shapes.glsl"
#include "shadowtech/exact/texel_cells.glsl"
#include "shadowtech/exact/walk_rows.glsl"

int lastRowOf(uint shape)
{
  return segments[shape].lastRow;
}

void walkRow(uint shape, int y)
{
  SegmentRecord segment = segments[shape];
  Part ofRow = Part(0.0lf, 1.0lf);
  if (!keepRow(ofRow, segment, y))
  {
    return;
  }
  Span columns = columnsOf(segment, ofRow);
  for (int x = columns.first; x <= columns.last; ++x)
  {
    Part part = ofRow;
    if (keepColumn(part, segment, x))
    {
      uint cell = cellAt(x, y);
      float nearest = nearestOf(segment, part);
      lower(cell + sharpEndInCell, nearest);
      if (segment.isEnd != 0u)
      {
        lower(cell + nearestInCell, nearest);
      }
    }
  }
}
