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

  /// What they know of each receiver, in the receivers' order. Receivers that need no shadow ray may
  /// get any answer.
  std::vector<Certainty> ask(const ReceiverPixels& receivers, const Occluders& occluders) const;

  std::size_t bytes() const;

private:
  Covering covering_;
  CasterEdges edges_;
  std::vector<ConservativeMap> maps_;
};

} // namespace gnomon

#endif
