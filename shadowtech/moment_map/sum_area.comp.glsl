// Builds summed-area tables (SummedAreaTable.h) in two passes. ROWS converts the texels of a layer
// to integers and sums them along rows. COLUMNS sums these along columns. Each invocation has one
// line.

layout(local_size_x = 16) in;

#ifdef ROWS
uniform sampler2DArray source;
uniform int layer;
uniform vec4 unitsOfOne; // powers of two
#endif
layout(binding = 0, FORMAT) uniform uimage2D table;

void main()
{
  int line = int(gl_GlobalInvocationID.x);
  ivec2 size = imageSize(table);
#ifdef ROWS
  if (line >= size.y)
  {
    return;
  }
  uvec4 sum = uvec4(0u);
  // The excess of texels so far over whole units. The first ones of rows are spread evenly over [0,
  // 1).
  vec4 rest = vec4(fract(0.6180339887 * float(line)));
  for (int i = 0; i < size.x; ++i)
  {
    vec4 value = unitsOfOne * texelFetch(source, ivec3(i, line, layer), 0);
    vec4 whole = floor(value);
    rest += value - whole; // the difference is exact, so it keeps its digits beside whole numbers
    vec4 carried = floor(rest);
    rest -= carried;
    sum += uvec4(ivec4(whole) + ivec4(carried));
    imageStore(table, ivec2(i, line), sum);
  }
#else
  if (line >= size.x)
  {
    return;
  }
  uvec4 sum = uvec4(0u);
  for (int i = 0; i < size.y; ++i)
  {
    sum += imageLoad(table, ivec2(line, i));
    imageStore(table, ivec2(line, i), sum);
  }
#endif
}
