#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <cstddef>
#include <functional>

namespace gnomon
{

/// Combine a value's hash with that of a whole.
template <typename Value>
void hashCombine(std::size_t& seed, const Value& value)
{
  seed ^= std::hash<Value>()(value) + 0x9e3779b97f4a7c15ull + (seed << 6) + (seed >> 2);
}

inline void hashMatrix(std::size_t& seed, const glm::dmat4& matrix)
{
  for (int i = 0; i < 16; ++i)
  {
    hashCombine(seed, glm::value_ptr(matrix)[i]);
  }
}

} // namespace gnomon
