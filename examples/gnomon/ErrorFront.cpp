#include "ErrorFront.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace gnomon::tool
{
namespace
{

/// Errors that differ by a smaller share count as equal.
constexpr double alike = 0.02;

} // namespace

//------------------------------------------------------------------------------
std::vector<std::size_t> paretoFront(const std::vector<ErrorAndTime>& ways)
{
  std::vector<std::size_t> order(ways.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    {
      return ways[a].time != ways[b].time ? ways[a].time < ways[b].time
                                          : ways[a].error < ways[b].error;
    });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t way : order)
  {
    if (front.empty() || ways[way].error < (1.0 - alike) * least)
    {
      front.push_back(way);
      least = ways[way].error;
    }
  }
  return front;
}

} // namespace gnomon::tool
