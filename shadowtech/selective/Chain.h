#pragma once

#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/vtkGnomonPixelClass.h"
#include "shadowtech/mesh/TriangleFans.h"
#include "shadowtech/selective/RimMaps.h"
#include "shadowtech/selective/TriangleMaps.h"
#include "shadowtech/tracing/ShadowTracer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon
{

struct ReceiverTile;

/// What becomes of pixels that nothing decides for certain.
enum class Leftovers
{
  Trace,   ///< they get their shadow ray
  Lit,     ///< they are lit: what nothing can prove to be in shadow mostly is
  Majority ///< they get the status that most of the nine texels around them say
};

/// What becomes of pixels outside of a contour.
enum class OutsideContour
{
  Map,  ///< they keep the status that the map says
  Check ///< those whose nine texels do not agree are treated as if they were inside
};

/// Which stages a chain has, in their order.
struct ChainStages
{
  int contourPixels = 0; ///< width of the contour; 0: the whole image
  OutsideContour outside = OutsideContour::Map;
  int coherenceTexels = 0; ///< 0, 4 or 9
  /// Of an area light: how many points around it see maps that have to agree with the centre's; 0:
  /// its shadows are the hard ones of its centre.
  std::size_t rimPoints = 0;
  int neighbourTexels = 0; ///< 0, 1, 4 or 9
  Adjacency adjacency = Adjacency::Off;
  Leftovers leftovers = Leftovers::Trace;
};

/// By what a chain decides a pixel: indices into classesOfChain().
enum class ChainClass : std::uint8_t
{
  NoReceiver,            ///< nothing is seen, or what receives no shadow
  Unreached,             ///< turned away from the light, or outside its cone or box
  OutsideLit,            ///< outside of the contour, by its texel
  OutsideShadow,         ///< the same
  HintedLit,             ///< by texels that agree
  HintedShadow,          ///< the same
  ConfirmedByTexel,      ///< in shadow by its texel, whose triangle is hit
  ConfirmedByNeighbours, ///< one of the other texels' triangles is
  ConfirmedByAdjacency,  ///< one that is adjacent to its texel's triangle is
  Corrected,             ///< lit by its texel, but one of the texels' triangles is hit
  TracedLit,             ///< traced; lit by its texel
  TracedShadow,          ///< traced; in shadow by its texel
  LeftLit,
  MajorityLit,
  MajorityShadow
};
std::vector<PixelClass> classesOfChain();

/// Moderno's chain (Shadow Mapping and Ray-Tracing, 3.6): pixels near a change of their status by
/// the shadow map pass one stage after the other, cheapest first, until one decides them. Confirmed
/// and corrected pixels are in shadow for certain; what is hinted, outside, left or by majority is
/// taken at its word.
class Chain : public ReceiverDecider
{
public:
  /// All of these have to live as long as the chain. Finds the contour, if there is to be one.
  /// @param rim of soft shadows, up to date: what is left is traced with all of the light's
  /// samples; null: with the ray to its centre
  /// @param fans up to date with the occluders where there is a stage of adjacency
  Chain(const ChainStages& stages, const TriangleMaps& maps, const RimMaps* rim,
    const TriangleFans& fans, const ScreenInput& input);

  /// Each pixel's visibility; fills the input's classes, if there are to be any.
  /// @return the number of rays traced
  std::size_t run(std::vector<float>& visibility) const;

  /// What run() lets the tracer know of a tile.
  void ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const override;

private:
  struct Look;
  Look lookAt(const ReceiverPixels& receivers, std::size_t i) const;
  ChainClass classOf(const Look& look, bool inContour) const;
  bool agree(const Look& look, Neighbourhood neighbourhood) const;
  std::optional<ChainClass> proof(const Look& look) const;
  std::vector<std::uint8_t> contour() const;

  const ChainStages& stages_;
  const TriangleMaps& maps_;
  const RimMaps* rim_;
  const TriangleFans& fans_;
  const ScreenInput& input_;
  ShadowRayLight rayLight_;
  std::vector<std::uint8_t> contour_; ///< 1 for its pixels; empty: the whole image
};

} // namespace gnomon
