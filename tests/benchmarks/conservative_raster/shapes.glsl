// What is drawn in a triangle's place, so that a fragment comes of every texel that it may touch; the fragment shader decides.
//
// OpenGL rounds vertices to a grid of at least 4 bits below a pixel, and cuts primitives at the map's border, in float: `snap`
// is more than that. No vertex is farther from the middle than twice the side.

uniform float size; // of the map, in texels
uniform float snap; // how far OpenGL may move vertices, in texels
// From a texel's centre to its side; 0 where OpenGL itself finds all texels that a shape touches.
uniform float halfTexel;

// A rectangle with a side along a unit vector.
struct Rectangle
{
  vec2 along;
  vec2 low, high; // along that vector, and to its left
};

vec2 placeIn(vec2 along, vec2 place)
{
  return vec2(dot(along, place), perp(along, place));
}

vec2 cornerOf(Rectangle rectangle, vec2 share)
{
  vec2 at = mix(rectangle.low, rectangle.high, share);
  return at.x * rectangle.along + at.y * vec2(-rectangle.along.y, rectangle.along.x);
}

float areaOf(Rectangle rectangle)
{
  vec2 sides = rectangle.high - rectangle.low;
  return sides.x * sides.y;
}

bool isOnMap(Rectangle rectangle)
{
  vec2 middle = cornerOf(rectangle, vec2(0.5));
  vec2 side = 0.5 * (rectangle.high - rectangle.low);
  vec2 reach = abs(side.x * rectangle.along) + abs(side.y * rectangle.along.yx);
  return all(lessThan(abs(middle) + reach, vec2(0.5 * size)));
}

// How far beside a triangle centres of texels may be that it touches, in x and in y.
float reachOf(Cover cover)
{
  return halfTexel + cover.margin + snap;
}

// The smallest such rectangle around all centres of texels that a triangle may touch.
Rectangle rectangleAlong(vec2 along, Cover cover)
{
  vec2 a = placeIn(along, cover.a);
  vec2 b = placeIn(along, cover.b);
  vec2 c = placeIn(along, cover.c);
  float reach = reachOf(cover) * sum(abs(along));
  return Rectangle(along, min(a, min(b, c)) - reach, max(a, max(b, c)) + reach);
}

vec2 longestSide(Cover cover)
{
  vec2 ab = cover.b - cover.a;
  vec2 bc = cover.c - cover.b;
  vec2 ca = cover.a - cover.c;
  vec2 longer = dot(ab, ab) > dot(bc, bc) ? ab : bc;
  return dot(longer, longer) > dot(ca, ca) ? longer : ca;
}

// Its part of the map. Nothing where low > high.
Rectangle boxOf(Cover cover)
{
  Rectangle box = rectangleAlong(vec2(1.0, 0.0), cover);
  box.low = max(box.low, -0.5 * size);
  box.high = min(box.high, 0.5 * size);
  return box;
}

// A needle's is a needle, along its longest side, and no more than twice as large as the triangle and what is around
// it. What would not lie on the map is drawn as a box, cut to it here.
Rectangle rectangleOf(Cover cover)
{
  Rectangle box = boxOf(cover);
  vec2 side = longestSide(cover);
  float lengthOfSide = length(side);
  if (lengthOfSide > 1.0)
  {
    Rectangle oriented = rectangleAlong(side / lengthOfSide, cover);
    if (isOnMap(oriented) && areaOf(oriented) < areaOf(box))
    {
      return oriented;
    }
  }
  return box;
}

bool isEmpty(Rectangle rectangle)
{
  return any(greaterThanEqual(rectangle.low, rectangle.high));
}

// The same by three vertices: the triangle with every side moved outwards by enough, as it is
// scaled about its centre of gravity, which is a third of the height from a side; 1.5 is more than sqrt(2), the most that a
// square reaches along a unit normal, and than the height's rounding. Where that would more than double it, as of
// needles and of what is small, the right angle around the rectangle.
vec2 wideCorner(Cover cover, int corner)
{
  vec2 centre = (cover.a + cover.b + cover.c) / 3.0;
  vec2 side = longestSide(cover);
  float height = abs(perp(cover.b - cover.a, cover.c - cover.a)) / max(length(side), tiny);
  float further = 3.0 * 1.5 * reachOf(cover) / max(height, tiny);
  vec2 scaled = max(abs(cover.a - centre), max(abs(cover.b - centre), abs(cover.c - centre)));
  if (further < 1.0 && all(lessThan(abs(centre) + 2.0 * scaled, vec2(size))))
  {
    vec2 own = corner == 0 ? cover.a : corner == 1 ? cover.b : cover.c;
    return centre + (1.0 + further) * (own - centre);
  }
  return cornerOf(rectangleOf(cover), vec2(corner == 1 ? 2.0 : 0.0, corner == 2 ? 2.0 : 0.0));
}

vec4 deviceOf(vec2 place)
{
  return vec4(place / (0.5 * size), 0.0, 1.0);
}

// A vertex of what is not drawn.
const vec4 nowhere = vec4(2.0, 2.0, 2.0, 1.0);
