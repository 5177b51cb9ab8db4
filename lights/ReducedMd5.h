#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace gnomon
{

/// Return 128 well mixed bits of a seed: 16 of MD5's 64 steps, the first four of each group, after
/// Curtis (*Real-Time Soft Shadows Using Monte Carlo Ray Tracing of Depth Maps*, 2009, section 3.1
/// and appendix A; the idea is by Tzeng and Wei 2008). Constants and word order are Curtis', not
/// RFC 1321's. So the samples equal the published ones, but the result is no MD5 digest.
///
/// @param seed a pixel, and the index of one of its numbers
/// @param key combined with all words of the seed by exclusive or
glm::uvec4 reducedMd5(glm::uvec4 seed, std::uint32_t key);

} // namespace gnomon
