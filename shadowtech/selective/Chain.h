#ifndef gnomon_shadowtech_selective_Chain_h
#define gnomon_shadowtech_selective_Chain_h

#include "lights/ShadowLight.h"
#include "shadowtech/base/RayTracer.h"
#include "shadowtech/selective/TriangleFans.h"
#include "shadowtech/selective/TriangleMaps.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

struct ReceiverPixels;

/// Which stages a chain has, in their order.
struct ChainStages
{
  int contourPixels = 0; ///< width of the contour; 0: the whole image
  OutsideContour outside = OutsideContour::Map;
  int coherenceTexels = 0; ///< 0, 4 or 9
  int neighbourTexels = 0; ///< 0, 1, 4 or 9
  Adjacency adjacency = Adjacency::Off;
  Leftovers leftovers = Leftovers::Trace;
};

/// By what a chain decides a pixel.
enum class PixelClass : std::uint8_t
{
  Background, ///< nothing is there that a shadow could fall on
  TurnedAway, ///< from the light, or outside of its cone or box: dark without a shadow
  OutsideLit, ///< outside of the contour, by its texel
  OutsideShadow,
  HintedLit, ///< by texels that agree; not for certain
  HintedShadow,
  ConfirmedByTexel,      ///< its own texel's triangle is hit
  ConfirmedByNeighbours, ///< one of a texel around
  ConfirmedByAdjacency,  ///< one that is adjacent to its own texel's
  Corrected,             ///< lit by its texel, but one of the texels' triangles is hit
  TracedLit,             ///< traced; lit by its texel
  TracedShadow,          ///< traced; in shadow by its texel
  LeftLit,
  MajorityLit,
  MajorityShadow
};
constexpr std::size_t pixelClasses = 15;

/// What a class means for a pixel's shadow ray. Confirmed and corrected pixels are in shadow for certain;
/// those hinted, outside, left or by majority are taken at their word.
Certainty certaintyOf(PixelClass of);

/// Moderno's chain (Shadow Mapping and Ray-Tracing, 3.6): pixels near a change of their status by the
/// shadow map pass one stage after the other, cheapest first, until one decides them.
class Chain
{
public:
  /// All of these have to live as long as the chain.
  /// @param fans up to date with the occluders where there is a stage of adjacency
  Chain(const ChainStages& stages, const TriangleMaps& maps, const TriangleFans& fans,
    const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers);

  /// What decides each pixel, in the receivers' order.
  std::vector<PixelClass> classes() const;

private:
  template <typename MakeRay>
  class OfLight;

  const ChainStages& stages_;
  const TriangleMaps& maps_;
  const TriangleFans& fans_;
  const ShadowLight& light_;
  const Occluders& occluders_;
  const ReceiverPixels& receivers_;
};

} // namespace gnomon

#endif
