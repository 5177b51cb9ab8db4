#pragma once

#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/vtkGnomonPixelClass.h"
#include "shadowtech/mesh/TriangleFans.h"
#include "shadowtech/selective/CertainHit.h"
#include "shadowtech/selective/RimMaps.h"
#include "shadowtech/selective/StatusContour.h"
#include "shadowtech/selective/TriangleMaps.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <algorithm>
#include <array>
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
inline std::vector<PixelClass> classesOfChain()
{
  // The classes without a shadow ray are those of tracing.
  const std::vector<PixelClass> tracing = classesOfTracing();
  return { tracing[static_cast<std::size_t>(TracedClass::NoReceiver)],
    tracing[static_cast<std::size_t>(TracedClass::Unreached)],
    { "outside the contour, lit", { 230, 230, 230 } },
    { "outside the contour, in shadow", { 90, 90, 90 } }, { "hinted lit", { 160, 200, 255 } },
    { "hinted in shadow", { 40, 90, 190 } }, { "confirmed by its texel", { 150, 70, 0 } },
    { "confirmed by neighbours", { 220, 110, 0 } }, { "confirmed by adjacency", { 255, 170, 60 } },
    { "corrected", { 220, 30, 30 } }, { "traced, lit by its texel", { 200, 120, 230 }, true },
    { "traced, in shadow by its texel", { 120, 20, 160 }, true }, { "left lit", { 255, 240, 60 } },
    { "lit by majority", { 250, 220, 150 } }, { "in shadow by majority", { 130, 110, 30 } } };
}

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
    const TriangleFans& fans, const ScreenInput& input)
    : stages_(stages)
    , maps_(maps)
    , rim_(rim)
    , fans_(fans)
    , input_(input)
    , rayLight_(input.light, input.occluders.frame.centre)
  {
    if (this->stages_.contourPixels > 0)
    {
      this->input_.receivers.all(); // they are read twice
      this->contour_ = this->contour();
    }
  }

  /// Compute each pixel's visibility, and fill the input's classes if it has any.
  /// @return the number of rays traced
  std::size_t run(std::vector<float>& visibility) const
  {
    if (this->input_.classes)
    {
      this->input_.classes->resize(
        this->input_.receivers.width() * this->input_.receivers.height());
    }
    const ScreenInput& input = this->input_;
    return this->rim_
      ? input.tracer.traceArea(input.light, input.occluders, input.receivers, visibility, this)
      : input.tracer.trace(input.light, input.occluders, input.receivers, visibility, this);
  }

  /// Decide the pixels of a tile for the tracer, during run().
  void ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const override
  {
    visitPixels(tile, this->input_.receivers.width(),
      [&](std::size_t i, std::size_t receiver, std::size_t pixel)
      {
        const bool inContour = this->contour_.empty() || this->contour_[pixel] != 0;
        const ChainClass found = this->classOf(this->lookAt(tile.receivers, receiver), inContour);
        certain[i] = certaintyOf(found);
        if (this->input_.classes)
        {
          (*this->input_.classes)[pixel] = static_cast<std::uint8_t>(found);
        }
      });
  }

private:
  static Neighbourhood neighbourhoodOf(int texels)
  {
    return texels == 9 ? Neighbourhood::Nine
      : texels == 4    ? Neighbourhood::Four
                       : Neighbourhood::Centre;
  }

  /// Return what a class decides about a pixel's shadow ray.
  static Certainty certaintyOf(ChainClass of)
  {
    switch (of)
    {
      case ChainClass::NoReceiver:
      case ChainClass::OutsideLit:
      case ChainClass::HintedLit:
      case ChainClass::LeftLit:
      case ChainClass::MajorityLit:
        return Certainty::Lit;
      case ChainClass::Unreached:
      case ChainClass::OutsideShadow:
      case ChainClass::HintedShadow:
      case ChainClass::ConfirmedByTexel:
      case ChainClass::ConfirmedByNeighbours:
      case ChainClass::ConfirmedByAdjacency:
      case ChainClass::Corrected:
      case ChainClass::MajorityShadow:
        return Certainty::Shadow;
      case ChainClass::TracedLit:
      case ChainClass::TracedShadow:
        break;
    }
    return Certainty::Uncertain;
  }

  /// Visit a tile's receivers.
  /// @param visit called with the pixel's number in the tile, its receiver's index, and its number
  /// in the picture
  template <typename Visit>
  static void visitPixels(const ReceiverTile& tile, std::size_t width, const Visit& visit)
  {
    for (std::size_t i = 0; i < tile.size(); ++i)
    {
      const std::size_t row = i / tile.columns;
      const std::size_t column = i % tile.columns;
      visit(i, tile.at(column, row), (tile.firstRow + row) * width + tile.firstColumn + column);
    }
  }

  /// A receiver, its shadow ray, and its status on the map.
  struct Look
  {
    bool receives = false;
    glm::vec3 normal{ 0.0f };
    glm::vec3 toCentre{ 0.0f }; ///< to the light's centre; of length 1 for directional lights
    ShadowRay ray{};
    float rayFar = 0.0f;
    std::optional<PlaceOnMaps> place; ///< only for rays that would be traced
    bool inShadow = false;            ///< the status

    PixelStatus status() const
    {
      return !this->receives ? PixelStatus::None
        : this->inShadow     ? PixelStatus::Shadow
                             : PixelStatus::Lit;
    }
  };

  Look lookAt(const ReceiverPixels& receivers, std::size_t i) const
  {
    Look look;
    const std::uint32_t surface = receivers.surface[i];
    look.receives =
      surface != ReceiverPixels::notCovered && this->input_.occluders.surfaces[surface].receives;
    if (!look.receives)
    {
      return look;
    }
    const glm::vec3 position = receivers.position(i);
    const glm::vec3 normal = receivers.normal(i);
    look.normal = normal;
    look.toCentre = this->rayLight_.kind == LightKind::Directional
      ? this->rayLight_.toLight
      : this->rayLight_.position - position;
    visitShadowRays(this->rayLight_,
      [&](const auto& makeRay, float rayFar)
      {
        look.ray = makeRay(position, normal, receivers.offset[i]);
        look.rayFar = rayFar;
      });
    if (look.ray.traced)
    {
      look.place = this->maps_.find(look.ray.origin, normal);
    }
    look.inShadow = !look.ray.traced || (look.place && look.place->shadows());
    return look;
  }

  ChainClass classOf(const Look& look, bool inContour) const
  {
    if (!look.receives)
    {
      return ChainClass::NoReceiver;
    }
    if (!look.ray.traced)
    {
      return ChainClass::Unreached;
    }
    const ChainStages& stages = this->stages_;
    if (!inContour &&
      (stages.outside == OutsideContour::Map || this->agree(look, Neighbourhood::Nine)))
    {
      return look.inShadow ? ChainClass::OutsideShadow : ChainClass::OutsideLit;
    }
    if (stages.coherenceTexels > 0 && this->agree(look, neighbourhoodOf(stages.coherenceTexels)))
    {
      return look.inShadow ? ChainClass::HintedShadow : ChainClass::HintedLit;
    }
    if (const std::optional<ChainClass> proven = this->proof(look))
    {
      return *proven;
    }
    switch (stages.leftovers)
    {
      case Leftovers::Lit:
        return ChainClass::LeftLit;
      case Leftovers::Majority:
        return look.place && look.place->votes() > 4 ? ChainClass::MajorityShadow
                                                     : ChainClass::MajorityLit;
      case Leftovers::Trace:
        break;
    }
    return look.inShadow ? ChainClass::TracedShadow : ChainClass::TracedLit;
  }

  /// Return true if the texels of all maps confirm a receiver's status.
  bool agree(const Look& look, Neighbourhood neighbourhood) const
  {
    // Without a place on the map no caster can be before the receiver, so all of its texels are
    // empty.
    if (look.place && !look.place->agree(neighbourhood))
    {
      return false;
    }
    return !this->rim_ ||
      this->rim_->agree(look.ray.origin, look.normal, look.toCentre, neighbourhood, look.inShadow);
  }

  /// Return the class of the test that proves a pixel to be in shadow, if one does.
  std::optional<ChainClass> proof(const Look& look) const
  {
    if (!look.place)
    {
      return std::nullopt;
    }
    const auto& [map, place] = *look.place;
    const auto stops = [&](const CasterTriangle& caster)
    { return certainlyStops(this->input_.occluders, caster, look.ray, look.rayFar); };

    std::array<CasterTriangle, 9> tested;
    auto end = tested.begin(); // of `tested`
    int texels = 0;
    const bool hit = this->stages_.neighbourTexels > 0 &&
      visitNeighbourhood(neighbourhoodOf(this->stages_.neighbourTexels), place,
        [&, map = map](int column, int row)
        {
          ++texels;
          const CasterTriangle& caster = map->texel(column, row).caster;
          if (!caster.exists() || std::find(tested.begin(), end, caster) != end)
          {
            return false;
          }
          *end++ = caster;
          return stops(caster);
        });
    if (hit)
    {
      return !look.inShadow ? ChainClass::Corrected
        : texels == 1       ? ChainClass::ConfirmedByTexel
                            : ChainClass::ConfirmedByNeighbours;
    }
    if (look.inShadow && this->stages_.adjacency != Adjacency::Off)
    {
      CasterTriangle caster = map->texel(place.column, place.row).caster;
      if (visitAdjacent(this->fans_.of(caster.surface), caster.triangle, this->stages_.adjacency,
            [&](std::uint32_t triangle)
            {
              caster.triangle = triangle;
              return stops(caster);
            }))
      {
        return ChainClass::ConfirmedByAdjacency;
      }
    }
    return std::nullopt;
  }

  std::vector<std::uint8_t> contour() const
  {
    const std::size_t width = this->input_.receivers.width();
    const std::size_t height = this->input_.receivers.height();
    std::vector<PixelStatus> statuses(width * height);
    this->input_.receivers.visitTiles(
      [&](const ReceiverTile& tile)
      {
        visitPixels(tile, width,
          [&](std::size_t, std::size_t receiver, std::size_t pixel)
          { statuses[pixel] = this->lookAt(tile.receivers, receiver).status(); });
      });
    return contourOf(
      statuses, static_cast<int>(width), static_cast<int>(height), this->stages_.contourPixels / 2);
  }

  const ChainStages& stages_;
  const TriangleMaps& maps_;
  const RimMaps* rim_;
  const TriangleFans& fans_;
  const ScreenInput& input_;
  ShadowRayLight rayLight_;
  std::vector<std::uint8_t> contour_; ///< 1 for its pixels; empty for the whole image
};

} // namespace gnomon
