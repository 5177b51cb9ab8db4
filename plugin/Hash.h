#ifndef gnomon_plugin_Hash_h
#define gnomon_plugin_Hash_h

#include <cstddef>
#include <functional>

namespace gnomon
{

/// Mixes a value's hash into that of a whole.
template <typename Value>
void hashCombine(std::size_t& seed, const Value& value)
{
  seed ^= std::hash<Value>()(value) + 0x9e3779b97f4a7c15ull + (seed << 6) + (seed >> 2);
}

} // namespace gnomon

#endif
