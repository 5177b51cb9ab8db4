// A triangle as a conservative map sees it: which texels it may touch, which it contains for certain, and what
// depths it has in them.
//
// Why that holds in float, whatever order sums are taken in and whether products are fused. Lengths are texels, places
// count from the map's middle, a *square of half side h* is all places within h of its centre in x and in y, and
// u = 2^-24.
//
// 1. Corners. Those computed here, t', are off the exact ones, t, by at most e in x and in y, and by at most e_d in
//    depth: what `rounding` says of X, Y, Q, W (8 u of the largest sum of products' sizes; a matrix rounded to float, four
//    products and their sum need 6 u), over W, and the division (2.5 units in the last place, 5 u).
// 2. Touched. If T touches a texel (h = 1/2), T' touches the square of half side 1/2 + e around its centre: the point of T'
//    with the same weights is within e. So no axis separates T' and that square, neither x, nor y, nor a side's normal.
// 3. Contained. If T' contains the square of half side 1/2 + e, T contains the texel. For if T did not, some direction n
//    would have n.q > n.t for a point q of the texel and all corners t. Then n.t' <= n.t + e |n|_1 < n.(q + e sign(n)), so that T'
//    would not contain q + e sign(n), which is in the square.
// 4. Sides. perp(b - a, centre - a) rounds by at most 4 u (extent + 1 + m) |b - a|_1 wherever x and y do not separate, and what
//    it is compared with by 3 u (1/2 + m) |b - a|_1. Both are part of the margin m.
// 5. Turned which way? The area's sign is trusted where it is more than rounding can make. Else both ways are
//    possible: what one of them touches is touched, and nothing is contained.
// 6. Depth. A point of T in a texel has, to within e_d, the depth that T' has at the point with the same weights, which is in
//    the square of half side 1/2 + e. So the plane of T' bounds it there, and so do the corners of T'. Slopes have rounding
//    of their own, which grows with the square of (terms / area): where that is too much, corners alone count.
// 7. What float cannot hold. A denormal may be flushed to 0: hence `tiny`. A triangle with a corner at or behind the light
//    or farther off than `farthest` touches every texel, at no depth at all, and contains none.

const float u = 5.9604645e-8;
const float tiny = 1e-30;
const float farthest = 1048576.0;
const float infinity = uintBitsToFloat(0x7f800000u);

uniform float margin; // by which all texels are to count as larger, on each side, in texels
uniform vec4 rounding; // how far X, Y, Q, W may be off

struct Cover
{
  vec2 a, b, c;
  float margin; // m, with what rounding asks for
  float turn; // 1: counter-clockwise, -1: clockwise, 0: either
  float depth; // of its plane at a
  vec2 slope; // of its plane
  float spread; // how far depth may be off the plane's at the centre, anywhere in the texel; rounding included
  float least, most; // its depths
};

float perp(vec2 a, vec2 b)
{
  return a.x * b.y - a.y * b.x;
}

float sum(vec2 of)
{
  return of.x + of.y;
}

float largest(vec3 of)
{
  return max(of.x, max(of.y, of.z));
}

float smallest(vec3 of)
{
  return min(of.x, min(of.y, of.z));
}

// Written so that NaN is not.
bool isNear(vec3 corner)
{
  return all(lessThan(abs(corner), vec3(farthest)));
}

// Corners in homogeneous coordinates: texels X/W and Y/W, depth Q/W.
Cover coverOf(vec4 first, vec4 second, vec4 third)
{
  vec3 W = vec3(first.w, second.w, third.w);
  vec3 p = first.xyz / W.x;
  vec3 q = second.xyz / W.y;
  vec3 r = third.xyz / W.z;
  if (!(all(greaterThan(W, vec3(4.0 * rounding.w))) && isNear(p) && isNear(q) && isNear(r)))
  {
    return Cover(vec2(0.0), vec2(0.0), vec2(0.0), farthest, 0.0, 0.0, vec2(0.0), infinity,
      -infinity, -infinity);
  }
  vec3 reach = max(abs(p), max(abs(q), abs(r)));
  float perW = 2.0 / smallest(W);
  float off = perW * (max(rounding.x, rounding.y) + max(reach.x, reach.y) * rounding.w) +
    16.0 * u * max(reach.x, reach.y);
  float offDepth = perW * (rounding.z + reach.z * rounding.w) + 16.0 * u * reach.z + tiny;

  vec2 box = max(p.xy, max(q.xy, r.xy)) - min(p.xy, min(q.xy, r.xy));
  float extent = max(box.x, box.y) + 2.0;
  Cover cover;
  cover.a = p.xy;
  cover.b = q.xy;
  cover.c = r.xy;
  cover.margin = margin + 1.02 * off + 8.0 * u * extent;

  vec2 pq = q.xy - p.xy;
  vec2 pr = r.xy - p.xy;
  float area = perp(pq, pr); // twice
  float terms = abs(pq.x * pr.y) + abs(pq.y * pr.x);
  cover.turn = abs(area) > 16.0 * u * terms + tiny ? sign(area) : 0.0;

  vec3 depths = vec3(p.z, q.z, r.z);
  cover.least = smallest(depths) - offDepth;
  cover.most = largest(depths) + offDepth;
  cover.depth = p.z;
  cover.slope = vec2(0.0);
  cover.spread = infinity;
  if (abs(area) > 1e-6 && terms < 1024.0 * abs(area))
  {
    float toQ = q.z - p.z;
    float toR = r.z - p.z;
    cover.slope = vec2(toQ * pr.y - toR * pq.y, toR * pq.x - toQ * pr.x) / area;
    float slopeTerms = (abs(toQ) * sum(abs(pr)) + abs(toR) * sum(abs(pq))) / abs(area);
    cover.spread = sum(abs(cover.slope)) * (0.5 + cover.margin) +
      64.0 * u * slopeTerms * (terms / abs(area)) * extent + offDepth;
  }
  return cover;
}

// What a triangle gives to the minima of a texel: x: no more than its least depth there, infinite where it does
// not touch the texel; y: no less than its greatest depth there, infinite where it does not contain the texel.
vec2 boundsIn(Cover cover, vec2 centre)
{
  float halfSide = 0.5 + cover.margin;
  vec2 low = min(cover.a, min(cover.b, cover.c)) - halfSide;
  vec2 high = max(cover.a, max(cover.b, cover.c)) + halfSide;
  if (any(lessThan(centre, low)) || any(greaterThan(centre, high)))
  {
    return vec2(infinity);
  }
  vec2 ab = cover.b - cover.a;
  vec2 bc = cover.c - cover.b;
  vec2 ca = cover.a - cover.c;
  vec3 sides =
    vec3(perp(ab, centre - cover.a), perp(bc, centre - cover.b), perp(ca, centre - cover.c));
  vec3 reach = halfSide * vec3(sum(abs(ab)), sum(abs(bc)), sum(abs(ca))) + tiny;
  bool touched = cover.turn >= 0.0 && all(greaterThanEqual(sides, -reach)) ||
    cover.turn <= 0.0 && all(lessThanEqual(sides, reach));
  if (!touched)
  {
    return vec2(infinity);
  }
  bool contained = cover.turn != 0.0 && all(greaterThanEqual(cover.turn * sides, reach));
  float depth = cover.depth + dot(cover.slope, centre - cover.a);
  return vec2(max(cover.least, depth - cover.spread),
    contained ? min(cover.most, depth + cover.spread) : infinity);
}
