#pragma once

#include <cstddef>
#include <vector>

namespace gnomon
{

/// What a vector holds on the heap, in use or not.
template <typename Value>
std::size_t bytesOf(const std::vector<Value>& vector)
{
  return vector.capacity() * sizeof(Value);
}

/// What a hash table of the standard library holds on the heap: its nodes, each with a pointer to
/// the next and, for keys whose hash is slow, the hash; and its buckets.
template <typename Table>
std::size_t bytesOfTable(const Table& table)
{
  const std::size_t buckets =
    table.bucket_count() > 1 ? table.bucket_count() : 0; // one is built in
  return table.size() * (sizeof(typename Table::value_type) + 2 * sizeof(void*)) +
    buckets * sizeof(void*);
}

} // namespace gnomon
