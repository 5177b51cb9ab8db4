#ifndef gnomon_tests_ChosenReceivers_h
#define gnomon_tests_ChosenReceivers_h

#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gnomon::test
{

/// Receivers that are put where a test wants them.
struct ChosenReceivers
{
  ReceiverPixels pixels;

  /// @param surface that they count as points of
  explicit ChosenReceivers(int count, std::uint32_t surface)
  {
    this->pixels.resize(count, 1);
    std::fill(this->pixels.surface.begin(), this->pixels.surface.end(), surface);
  }
  void set(std::size_t i, const glm::dvec3& centred, const glm::dvec3& normal, float offset)
  {
    this->pixels.positionX[i] = static_cast<float>(centred.x);
    this->pixels.positionY[i] = static_cast<float>(centred.y);
    this->pixels.positionZ[i] = static_cast<float>(centred.z);
    this->pixels.normalX[i] = static_cast<float>(normal.x);
    this->pixels.normalY[i] = static_cast<float>(normal.y);
    this->pixels.normalZ[i] = static_cast<float>(normal.z);
    this->pixels.offset[i] = offset;
  }
};

} // namespace gnomon::test

#endif
