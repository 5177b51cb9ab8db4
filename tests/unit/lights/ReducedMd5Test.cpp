#include "lights/ReducedMd5.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace gnomon::test
{
namespace
{

/// Computed by a separate implementation.
TEST(ReducedMd5, givesThePublishedNumbers)
{
  struct Case
  {
    glm::uvec4 seed;
    std::uint32_t key;
    glm::uvec4 words;
  };
  const std::array<Case, 8> cases{ {
    { { 0u, 0u, 0u, 0u }, 0u, { 0x9849996eu, 0x61c2b03bu, 0x4663dbefu, 0xfe85c476u } },
    { { 1u, 0u, 0u, 0u }, 0u, { 0xfc6c0fb3u, 0xfd47b408u, 0x04f5305du, 0xef967456u } },
    { { 0u, 1u, 0u, 0u }, 0u, { 0x7681c30bu, 0xac1462e8u, 0x869fd967u, 0xa3e26fb4u } },
    { { 1u, 2u, 3u, 4u }, 0u, { 0x4f68a50bu, 0x55ec1f9eu, 0x00f7d906u, 0x00f77bd5u } },
    { { 0u, 0u, 0u, 0u }, 0xdeadbeefu, { 0x0747bb04u, 0x0a54e35du, 0x541e778du, 0xf4b80748u } },
    { { 100u, 200u, 0u, 0u }, 0u, { 0xe650601fu, 0xd424ea9cu, 0x4aad8c25u, 0x70350f73u } },
    { { 1023u, 767u, 0u, 0u }, 7u, { 0x6c64bb06u, 0x4939c55cu, 0x782a3a23u, 0x99d885ecu } },
    { glm::uvec4(0xffffffffu), 0u, { 0x8cb35b63u, 0xf614ce39u, 0xe9a694d6u, 0x31c50d7bu } },
  } };
  for (const Case& each : cases)
  {
    EXPECT_EQ(reducedMd5(each.seed, each.key), each.words) << each.seed.x << " " << each.key;
  }
}

} // namespace
} // namespace gnomon::test
