// Computes means over BLUR_TEXELS texels along a row or a column, at a cost that does not depend on
// their number. The method is the blocks of van Herk (1992) and Gil and Werman (1993), with sums in
// place of maxima.
//
// The line is divided into blocks as long as the box. A box that begins inside a block covers the
// end of that block and the beginning of the next. So its sum is one suffix plus one prefix, each
// one addition from its neighbour. Nothing is subtracted. So rounding does not accumulate along the
// line, as it does in sliding sums or summed-area tables.

layout(local_size_x = 64) in;

uniform sampler2DArray source;
uniform int layer;
uniform ivec2 axis; // direction of the line
uniform vec4 empty; // the moments without a caster, as outside the layer
layout(binding = 0, FORMAT) writeonly uniform image2D target;

vec4 momentsAt(ivec2 texel, ivec2 size)
{
  bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, size));
  return inside ? texelFetch(source, ivec3(texel, layer), 0) : empty;
}

void main()
{
  ivec2 size = textureSize(source, 0).xy;
  ivec2 across = ivec2(1) - axis;
  ivec2 line = int(gl_GlobalInvocationID.x) * across;
  if (any(greaterThanEqual(line, size)))
  {
    return;
  }
  // The box of texel i begins at i - BLUR_TEXELS / 2.
  int first = int(gl_GlobalInvocationID.y) * BLUR_TEXELS;
  ivec2 begin = line + (first - BLUR_TEXELS / 2) * axis;

  vec4 suffix[BLUR_TEXELS];
  vec4 sum = vec4(0.0);
  for (int i = BLUR_TEXELS - 1; i >= 0; --i)
  {
    sum += momentsAt(begin + i * axis, size);
    suffix[i] = sum;
  }
  vec4 prefix = vec4(0.0);
  int last = min(BLUR_TEXELS, (axis.x == 1 ? size.x : size.y) - first);
  for (int i = 0; i < last; ++i)
  {
    imageStore(target, line + (first + i) * axis, (suffix[i] + prefix) / float(BLUR_TEXELS));
    prefix += momentsAt(begin + (BLUR_TEXELS + i) * axis, size);
  }
}
