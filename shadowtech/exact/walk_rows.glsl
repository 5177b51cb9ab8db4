// Who walks which rows of what is drawn. An invocation walks all rows of a shape; with ROW_EACH an
// invocation of a work group has one row of a shape. GROUP: invocations of a work group.

layout(local_size_x = GROUP) in;

layout(std430, binding = 4) readonly buffer Walks { uvec2 walks[]; }; // the number of a shape, and a row of it

uniform int firstWalk; // of these
uniform int walkCount;

// To be defined by who includes this.
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
