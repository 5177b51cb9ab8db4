#ifndef gnomon_shadowtech_conservative_ConservativeMaps_h
#define gnomon_shadowtech_conservative_ConservativeMaps_h

#include "lights/LightViews.h"
#include "shadowtech/conservative/CasterEdges.h"
#include "shadowtech/conservative/ConservativeMap.h"

#include <vector>

namespace gnomon
{

struct ReceiverPixels;

/// The conservative maps of all of a light's views.
class ConservativeMaps
{
public:
  explicit ConservativeMaps(Covering covering)
    : covering_(covering)
  {
  }

  /// Draws the casters into a map per view.
  /// @throws TextureMemoryError for maps without room; there are none then
  void bake(const LightViews& views, int sizeTexels, const Occluders& occluders);

  /// By surface + 1, so that `notCovered` + 1 = 0 is the first: whether it casts, on both sides.
  static std::vector<std::uint8_t> onCaster(const Occluders& occluders);

  /// Decides receivers that are still uncertain. Of those that need no shadow ray it may say anything.
  /// @param certain of each receiver, in the receivers' order
  void ask(const ReceiverPixels& receivers, const std::vector<std::uint8_t>& onCaster,
    std::vector<Certainty>& certain) const;

  std::size_t bytes() const;

private:
  Covering covering_;
  CasterEdges edges_;
  std::vector<ConservativeMap> maps_;
};

} // namespace gnomon

#endif
