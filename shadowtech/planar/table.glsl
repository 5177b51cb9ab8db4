// A long table in a texture, row by row (IntegerTable.h).

#ifndef GNOMON_TABLE
#define GNOMON_TABLE

uvec4 tableEntry(usampler2D table, int number)
{
  int columns = textureSize(table, 0).x;
  return texelFetch(table, ivec2(number % columns, number / columns), 0);
}

#endif
