// A share that is exactly 1 where part and whole are equal. OpenGL's division may be off by 2.5 ulp
// (GLSL 4.60, section 4.7.1), and on NVIDIA a number over itself is not always 1.

#ifndef GNOMON_SHARE
#define GNOMON_SHARE

float shareOf(float part, float whole)
{
  return part >= whole ? 1.0 : min(part / whole, 1.0);
}

#endif
