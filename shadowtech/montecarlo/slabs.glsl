// The solid parts in a texel of a light's map: slabs between two depths of ray space (RaySpace.h).
// A page holds two as (begin, -end, begin, -end), so that the least numbers give the hull of
// several.

// Begins behind all depths and ends before them, so nothing meets it.
#define NO_SLAB vec2(2.0, 2.0)
