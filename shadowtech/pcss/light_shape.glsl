// The shape of an area light, of radius or half side 1.

uniform mat3 lightFromUnit_LIGHT; // its axes in light space

// How far a point of the shape is out, from 0 in its middle to 1 at its rim.
float extentOf_LIGHT(vec2 place)
{
#if PCSS_RECTANGLE_LIGHT
  return max(abs(place.x), abs(place.y));
#else
  return length(place);
#endif
}

// How far the whole shape reaches along a direction.
// @param axes how far its two axes do
float extentAlong_LIGHT(vec2 axes)
{
#if PCSS_RECTANGLE_LIGHT
  return abs(axes.x) + abs(axes.y);
#else
  return length(axes);
#endif
}
