#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace gnomon
{

/// What makes a pixel's samples of a light differ from those of other pixels. The default gives the
/// samples that all pixels may share.
struct SamplePixel
{
  glm::uvec3 bits{ 0u };
  std::uint32_t order = 0;
};

} // namespace gnomon
