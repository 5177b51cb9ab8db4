#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace gnomon
{

/// 128 well mixed bits of a place: 16 of MD5's 64 steps, the first four of each of its groups,
/// after Curtis (*Real-Time Soft Shadows Using Monte Carlo Ray Tracing of Depth Maps*, 2009,
/// section 3.1 and appendix A; the idea is that of Tzeng and Wei 2008). Its constants and the order
/// of its words are Curtis', which are not those of RFC 1321: so it gives the same samples as what
/// was published, and no digest.
///
/// @param seed the place: a pixel, and which of its numbers
/// @param key added to all words of the seed by exclusive or
glm::uvec4 reducedMd5(glm::uvec4 seed, std::uint32_t key);

} // namespace gnomon
