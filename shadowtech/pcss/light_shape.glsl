// The shape of an area light, of radius or half side 1.

uniform mat3 lightFromUnit_LIGHT; // the shape's axes in light space

// Return how far out a point of the shape is, from 0 in the middle to 1 at the rim.
float extentOf_LIGHT(vec2 place)
{
#if PCSS_RECTANGLE_LIGHT
  return max(abs(place.x), abs(place.y));
#else
  return length(place);
#endif
}

// Return the extent of the whole shape along a direction.
// @param axes extents of its two axes along it
float extentAlong_LIGHT(vec2 axes)
{
#if PCSS_RECTANGLE_LIGHT
  return abs(axes.x) + abs(axes.y);
#else
  return length(axes);
#endif
}
