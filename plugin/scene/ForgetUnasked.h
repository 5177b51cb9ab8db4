#pragma once

#include <iterator>
#include <utility>

namespace gnomon
{

/// Begins a frame of a table whose entries have a mark `asked`: takes out those that were not asked
/// for since the last call, and takes the mark from the others.
template <typename Table>
void forgetUnasked(Table& table)
{
  for (auto entry = table.begin(); entry != table.end();)
  {
    entry = std::exchange(entry->second.asked, false) ? std::next(entry) : table.erase(entry);
  }
}

} // namespace gnomon
