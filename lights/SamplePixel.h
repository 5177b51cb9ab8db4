#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace gnomon
{

/// The values that make a pixel's light samples differ from other pixels' samples. The default
/// gives samples that all pixels may share.
struct SamplePixel
{
  glm::uvec3 bits{ 0u };
  std::uint32_t order = 0;
};

} // namespace gnomon
