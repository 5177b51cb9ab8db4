#pragma once

#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/vtkGnomonPixelClass.h"
#include "shadowtech/mesh/TriangleFans.h"
#include "shadowtech/selective/RimMaps.h"
#include "shadowtech/selective/TriangleMaps.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon
{

struct ReceiverTile;

/// The stages of a chain, in order.
struct ChainStages
{
  int contourPixels = 0; ///< width of the contour; 0 for the whole image
  OutsideContour outside = OutsideContour::Map;
  int coherenceTexels = 0; ///< 0, 4 or 9
  /// For area lights, the number of points around the light whose maps must agree with the
  /// centre's. 0 shows the hard shadows of the centre.
  std::size_t rimPoints = 0;
  int neighbourTexels = 0; ///< 0, 1, 4 or 9
  Adjacency adjacency = Adjacency::Off;
  Leftovers leftovers = Leftovers::Trace;
};

/// The stage that decided a pixel: indices into classesOfChain().
enum class ChainClass : std::uint8_t
{
  NoReceiver,            ///< background, or a surface that receives no shadow
  Unreached,             ///< turned away from the light, or outside its cone or box
  OutsideLit,            ///< outside the contour, by its texel
  OutsideShadow,         ///< the same
  HintedLit,             ///< by texels that agree
  HintedShadow,          ///< the same
  ConfirmedByTexel,      ///< in shadow by its texel, whose triangle is hit
  ConfirmedByNeighbours, ///< a triangle of another texel is hit
  ConfirmedByAdjacency,  ///< a triangle adjacent to its texel's is hit
  Corrected,             ///< lit by its texel, but a triangle of the texels is hit
  TracedLit,             ///< traced; lit by its texel
  TracedShadow,          ///< traced; in shadow by its texel
  LeftLit,
  MajorityLit,
  MajorityShadow
};
std::vector<PixelClass> classesOfChain();

/// Moderno's chain (Shadow Mapping and Ray-Tracing, 3.6). Pixels near a change of their status on
/// the shadow map pass stages, cheapest first, until one decides them. Confirmed and corrected
/// pixels are certainly in shadow. Classes hinted, outside, left and by majority are not verified.
class Chain : public ReceiverDecider
{
public:
  /// Find the contour, if the stages have one. All arguments must outlive the chain.
  /// @param rim maps of an area light, up to date; undecided pixels are traced with all samples.
  /// Null traces the ray to the centre only.
  /// @param fans up to date with the occluders if adjacency is a stage
  Chain(const ChainStages& stages, const TriangleMaps& maps, const RimMaps* rim,
    const TriangleFans& fans, const ScreenInput& input);

  /// Compute each pixel's visibility, and fill the input's classes if it has any.
  /// @return the number of rays traced
  std::size_t run(std::vector<float>& visibility) const;

  /// Decide the pixels of a tile for the tracer, during run().
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
  std::vector<std::uint8_t> contour_; ///< 1 for its pixels; empty for the whole image
};

} // namespace gnomon
