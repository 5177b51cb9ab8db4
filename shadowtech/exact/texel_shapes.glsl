// Finds the texels that polygons and edges meet, row by row, in double precision. These are the
// twins of PolygonOnTexels and SegmentOnTexels (TexelShapes.h).
//
// They agree to the last bit if OpenGL rounds to nearest even. GLSL does not promise it, so the
// tests check each driver. `precise` prevents fused operations, and divisions, which need not be
// exact, are avoided.
//
// SAMPLE_OFFSET, SAMPLE_ON_EDGE: constants of TexelShapes.h.

struct SideRecord
{
  double perNx, ny, c, support;
};

struct PolygonRecord
{
  double touchedLeft, touchedRight, left, right;
  double originX, originY, originDepth;
  double perX, perY;
  double toSample;
  double spread;
  float least, most, climb, slack, noise;
  uint covers;
  uint firstSide, sideCount;
  int firstRow, lastRow;
};

struct SegmentRecord
{
  double x, y, depth;
  double alongX, alongDepth;
  double perX, perY;
  double margin, slack;
  uint isEnd;
  int firstRow, lastRow;
  uint unused;
};

layout(std430, binding = 0) readonly buffer Polygons { PolygonRecord polygons[]; };
layout(std430, binding = 1) readonly buffer Sides { SideRecord sides[]; };
layout(std430, binding = 2) readonly buffer Segments { SegmentRecord segments[]; };

uniform int width; // of the map, in texels

struct Span
{
  int first, last;
};

bool isIn(Span span, int x)
{
  return x >= span.first && x <= span.last;
}

struct RowRange
{
  double low, high;
};

void cut(inout RowRange range, double perRest, double rest)
{
  precise double bound = rest * perRest;
  if (perRest < 0.0lf)
  {
    range.low = max(range.low, bound);
  }
  else if (perRest > 0.0lf)
  {
    range.high = min(range.high, bound);
  }
  else if (rest < 0.0lf)
  {
    range.high = -2.0lf;
  }
}

Span texelsOf(RowRange range, double at)
{
  precise double low = range.low - at;
  precise double high = range.high - at;
  return Span(int(ceil(clamp(low, 0.0lf, double(width)))),
    int(floor(clamp(high, -1.0lf, double(width - 1)))));
}

struct Row
{
  Span touched, contained, sampled;
  double depth;
};

Row rowOf(PolygonRecord polygon, int y)
{
  precise double sampledLeft = polygon.left - SAMPLE_ON_EDGE;
  precise double sampledRight = polygon.right + SAMPLE_ON_EDGE;
  RowRange touched = RowRange(polygon.touchedLeft, polygon.touchedRight);
  RowRange contained = RowRange(polygon.left, polygon.right);
  RowRange sampled = RowRange(sampledLeft, sampledRight);
  precise double centre = double(y) + 0.5lf;
  for (uint i = 0u; i < polygon.sideCount; ++i)
  {
    SideRecord side = sides[polygon.firstSide + i];
    precise double rest = side.ny * centre + side.c;
    precise double ofTouched = rest + side.support;
    precise double ofContained = rest - side.support;
    precise double ofSampled = rest + side.ny * SAMPLE_OFFSET + SAMPLE_ON_EDGE;
    cut(touched, side.perNx, ofTouched);
    cut(contained, side.perNx, ofContained);
    cut(sampled, side.perNx, ofSampled);
  }
  precise double depth = polygon.originDepth + polygon.perX * (0.5lf - polygon.originX) +
    polygon.perY * (centre - polygon.originY);
  return Row(texelsOf(touched, 0.5lf), texelsOf(contained, 0.5lf),
    texelsOf(sampled, 0.5lf + SAMPLE_OFFSET), depth);
}

double depthAt(PolygonRecord polygon, Row row, int x)
{
  precise double depth = row.depth + polygon.perX * double(x);
  return depth;
}

float nearestOf(PolygonRecord polygon, double depth)
{
  precise double least = depth - polygon.spread;
  precise float nearest = max(polygon.least, float(least)) - polygon.slack;
  return nearest;
}

float farthestOf(PolygonRecord polygon, double depth)
{
  precise double most = depth + polygon.spread;
  precise float farthest = min(polygon.most, float(most)) + polygon.slack;
  return farthest;
}

float atSample(PolygonRecord polygon, double depth)
{
  precise double sampled = depth + polygon.toSample;
  return float(sampled);
}

// A part of an edge, from 0 at its first end to 1.
struct Part
{
  double first, last;
};

bool keepBetween(inout Part part, double from, double perTexel, double low, double high)
{
  if (perTexel == 0.0lf)
  {
    return from >= low - 1e-9lf && from <= high + 1e-9lf;
  }
  precise double t0 = (low - from) * perTexel;
  precise double t1 = (high - from) * perTexel;
  part.first = max(part.first, min(t0, t1));
  part.last = min(part.last, max(t0, t1));
  return part.first <= part.last;
}

// Clip an edge to a row.
bool keepRow(inout Part part, SegmentRecord segment, int y)
{
  precise double low = double(y) - segment.margin;
  precise double high = double(y) + 1.0lf + segment.margin;
  return keepBetween(part, segment.y, segment.perY, low, high);
}

// Clip that part to a column.
bool keepColumn(inout Part part, SegmentRecord segment, int x)
{
  precise double low = double(x) - segment.margin;
  precise double high = double(x) + 1.0lf + segment.margin;
  return keepBetween(part, segment.x, segment.perX, low, high);
}

Span columnsOf(SegmentRecord segment, Part ofRow)
{
  precise double x0 = segment.x + ofRow.first * segment.alongX;
  precise double x1 = segment.x + ofRow.last * segment.alongX;
  precise double low = min(x0, x1) - segment.margin;
  precise double high = max(x0, x1) + segment.margin;
  return Span(int(floor(clamp(low, 0.0lf, double(width)))),
    int(floor(clamp(high, -1.0lf, double(width - 1)))));
}

float nearestOf(SegmentRecord segment, Part part)
{
  precise double first = part.first * segment.alongDepth;
  precise double last = part.last * segment.alongDepth;
  precise double nearest = segment.depth + min(first, last) - segment.slack;
  return float(nearest);
}
