// Hashes a place to 128 well mixed bits: the twin of reducedMd5() (lights/ReducedMd5.h), with
// Curtis' constants (2009, appendix A).

#define MD5_STEP(MIXED, WORD, CONSTANT, TURN)                               \
  added = state.x + (MIXED) + (WORD) + CONSTANT;                            \
  state = uvec4(state.yzw, state.y + ((added << TURN) | (added >> (32 - TURN)))); \
  sum += state;
#define MD5_F ((state.x & state.y) | (~state.x & state.z))
#define MD5_G ((state.z & state.x) | (~state.z & state.y))
#define MD5_H (state.x ^ state.y ^ state.z)
#define MD5_I (state.y ^ (state.x | ~state.z))

uvec4 reducedMd5(uvec4 seed, uint key)
{
  seed ^= uvec4(key);
  uvec4 state = uvec4(0x01234567u, 0x89abcdefu, 0xfedcba98u, 0x76543210u);
  uvec4 sum = state;
  uint added;
  MD5_STEP(MD5_F, seed.x, 0xd76aa478u, 7)
  MD5_STEP(MD5_F, seed.y, 0xe8c7b757u, 12)
  MD5_STEP(MD5_F, seed.z, 0x242070dbu, 17)
  MD5_STEP(MD5_F, seed.w, 0xc1bdceefu, 22)
  MD5_STEP(MD5_G, seed.y, 0xf61e2562u, 5)
  MD5_STEP(MD5_G, 0u, 0xc040b341u, 9)
  MD5_STEP(MD5_G, 0u, 0x265e5a52u, 14)
  MD5_STEP(MD5_G, seed.x, 0xe9b6c7abu, 20)
  MD5_STEP(MD5_H, 0u, 0xfffa3942u, 4)
  MD5_STEP(MD5_H, 0u, 0x8771f681u, 11)
  MD5_STEP(MD5_H, 0u, 0x6d9d6122u, 16)
  MD5_STEP(MD5_H, 0u, 0xfde5380cu, 23)
  MD5_STEP(MD5_I, seed.x, 0xf4292244u, 6)
  MD5_STEP(MD5_I, 0u, 0x432aff98u, 10)
  MD5_STEP(MD5_I, 0u, 0xab9423a7u, 15)
  MD5_STEP(MD5_I, 0u, 0xfc93a039u, 21)
  return sum;
}
