#include "lights/ReducedMd5.h"

#include <array>

namespace gnomon
{
namespace
{

/// A step: the index of the seed's word that it adds (4: none), its constant, and its rotation in
/// bits.
struct Step
{
  int word;
  std::uint32_t constant;
  int turn;
};

constexpr int noWord = 4;
constexpr int stepsOfGroup = 4;

/// Constants as Curtis prints them: most of the first two groups are MD5's rounded up, where MD5
/// truncates. Words 4 to 15 of MD5's message are 0.
constexpr std::array<Step, 16> steps{ {
  { 0, 0xd76aa478u, 7 },
  { 1, 0xe8c7b757u, 12 },
  { 2, 0x242070dbu, 17 },
  { 3, 0xc1bdceefu, 22 },
  { 1, 0xf61e2562u, 5 },
  { noWord, 0xc040b341u, 9 },
  { noWord, 0x265e5a52u, 14 },
  { 0, 0xe9b6c7abu, 20 },
  { noWord, 0xfffa3942u, 4 },
  { noWord, 0x8771f681u, 11 },
  { noWord, 0x6d9d6122u, 16 },
  { noWord, 0xfde5380cu, 23 },
  { 0, 0xf4292244u, 6 },
  { noWord, 0x432aff98u, 10 },
  { noWord, 0xab9423a7u, 15 },
  { noWord, 0xfc93a039u, 21 },
} };

/// Return the group's function of three words of the state.
std::uint32_t mixed(std::size_t group, const glm::uvec4& state)
{
  const std::uint32_t x = state[0];
  const std::uint32_t y = state[1];
  const std::uint32_t z = state[2];
  switch (group)
  {
    case 0:
      return (x & y) | (~x & z);
    case 1:
      return (z & x) | (~z & y);
    case 2:
      return x ^ y ^ z;
    default:
      return y ^ (x | ~z);
  }
}

} // namespace

glm::uvec4 reducedMd5(glm::uvec4 seed, std::uint32_t key)
{
  seed = seed ^ glm::uvec4(key); // GLM 1.0.1 declares ^= nodiscard
  glm::uvec4 state(0x01234567u, 0x89abcdefu, 0xfedcba98u, 0x76543210u);
  glm::uvec4 sum = state;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const Step& step = steps[i];
    const std::uint32_t word = step.word == noWord ? 0u : seed[step.word];
    const std::uint32_t added = state[0] + mixed(i / stepsOfGroup, state) + word + step.constant;
    const std::uint32_t turned = (added << step.turn) | (added >> (32 - step.turn));
    state = { state[1], state[2], state[3], state[1] + turned };
    sum += state;
  }
  return sum;
}

} // namespace gnomon
