// Assigns rows of shapes to invocations. By default, an invocation rasterizes all rows of a shape.
// With ROW_EACH, each invocation of a work group rasterizes one row. GROUP: invocations per work
// group.

layout(local_size_x = GROUP) in;

// Pairs of a shape's number and a row of it.
layout(std430, binding = 4) readonly buffer Walks { uvec2 walks[]; };

uniform int firstWalk; // index into `walks`
uniform int walkCount;

// The including shader defines these.
void walkRow(uint shape, int y);
int lastRowOf(uint shape);

void main()
{
#ifdef ROW_EACH
  uvec2 walk = walks[firstWalk + int(gl_WorkGroupID.x)];
  int y = int(walk.y) + int(gl_LocalInvocationID.x);
  if (y <= lastRowOf(walk.x))
  {
    walkRow(walk.x, y);
  }
#else
  if (int(gl_GlobalInvocationID.x) < walkCount)
  {
    uvec2 walk = walks[firstWalk + int(gl_GlobalInvocationID.x)];
    int last = lastRowOf(walk.x);
    for (int y = int(walk.y); y <= last; ++y)
    {
      walkRow(walk.x, y);
    }
  }
#endif
}
