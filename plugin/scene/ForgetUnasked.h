#pragma once

#include <iterator>
#include <utility>

namespace gnomon
{

/// Begin a frame of a table whose entries have a flag `asked`: remove the entries without it, and
/// clear it in the others.
template <typename Table>
void forgetUnasked(Table& table)
{
  for (auto entry = table.begin(); entry != table.end();)
  {
    entry = std::exchange(entry->second.asked, false) ? std::next(entry) : table.erase(entry);
  }
}

} // namespace gnomon
