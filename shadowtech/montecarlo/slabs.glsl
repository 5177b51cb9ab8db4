// What is solid in a texel of a light's map: slabs between two depths of ray space (RaySpace.h),
// two to a page.

#define NO_SLAB vec2(2.0, -2.0) // from behind all depths to before them: nothing meets it
