#include "plugin/scene/WantedSurfaces.h"

#include "vtkActor.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <unordered_map>

namespace gnomon
{

std::vector<WantedSurface> wantedSurfaces(
  const DrawnProps& drawn, const std::vector<SurfaceRecord>& records)
{
  std::vector<WantedSurface> wanted;
  wanted.reserve(std::max(drawn.blocks.size(), records.size()));
  for (const DrawnProp& prop : drawn.props)
  {
    for (std::size_t block = 0; block < prop.blockCount; ++block)
    {
      const DrawnBlock& drawnBlock = drawn.blocks[prop.firstBlock + block];
      for (const SurfaceCells cells : cellsOf(drawnBlock))
      {
        if (cellCount(drawnBlock.data, cells) > 0)
        {
          wanted.push_back(
            { { prop.viewProp, prop.path, prop.actor, prop.translucent, drawnBlock.data,
                drawnBlock.glyphPoints, drawnBlock.glyphSource, cells },
              drawnBlock, &prop, WantedSurface::none, nullptr });
        }
      }
    }
  }

  // Most frames list the same surfaces in the same order. Only other frames need the lookup.
  std::unordered_map<SurfaceKey, std::size_t, SurfaceKeyHash> oldOfKey;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    if (oldOfKey.empty() && i < records.size() && records[i].key == wanted[i].key)
    {
      wanted[i].old = i;
      continue;
    }
    if (oldOfKey.empty())
    {
      for (std::size_t old = i; old < records.size(); ++old)
      {
        oldOfKey.emplace(records[old].key, old);
      }
    }
    const auto found = oldOfKey.find(wanted[i].key);
    if (found != oldOfKey.end())
    {
      wanted[i].old = found->second;
    }
  }
  return wanted;
}

} // namespace gnomon
