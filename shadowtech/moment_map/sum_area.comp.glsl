// Summed-area tables (SummedAreaTable.h), in two passes: ROWS turns the texels of a layer into
// integers and sums them along its rows, COLUMNS sums those sums along the columns. One invocation
// has a line.

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
  // What the texels so far have in excess of whole units. The rows' first ones are spread evenly
  // over [0, 1).
  vec4 rest = vec4(fract(0.6180339887 * float(line)));
  for (int i = 0; i < size.x; ++i)
  {
    vec4 value = unitsOfOne * texelFetch(source, ivec3(i, line, layer), 0);
    vec4 whole = floor(value);
    rest += value - whole; // exact before it is added: whole numbers' rests are not lost beside them
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
