#pragma once

#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

namespace gnomon
{

/// Return a vector's bytes on the heap, unused capacity included.
template <typename Value>
std::size_t bytesOf(const std::vector<Value>& vector)
{
  return vector.capacity() * sizeof(Value);
}

/// Return the sum of bytes over a container's elements.
/// @param bytesOfOne a function or member function
template <typename Container, typename BytesOfOne>
std::size_t bytesOfAll(const Container& container, const BytesOfOne& bytesOfOne)
{
  return std::accumulate(container.begin(), container.end(), std::size_t{ 0 },
    [&](std::size_t sum, const auto& one) { return sum + std::invoke(bytesOfOne, one); });
}

/// Return the bytes on the heap of a hash table of the standard library. Each node has a pointer to
/// the next node and, for keys whose hash is slow, the hash; the buckets are pointers.
template <typename Table>
std::size_t bytesOfTable(const Table& table)
{
  const std::size_t buckets =
    table.bucket_count() > 1 ? table.bucket_count() : 0; // one is built in
  return table.size() * (sizeof(typename Table::value_type) + 2 * sizeof(void*)) +
    buckets * sizeof(void*);
}

} // namespace gnomon
