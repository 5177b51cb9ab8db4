#include "shadowtech/selective/Chain.h"

#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/selective/CertainHit.h"
#include "shadowtech/selective/StatusContour.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>

namespace gnomon
{
namespace
{

Neighbourhood neighbourhoodOf(int texels)
{
  return texels == 9 ? Neighbourhood::Nine
    : texels == 4    ? Neighbourhood::Four
                     : Neighbourhood::Centre;
}

/// Calls `visit` with ranges of pixels, on all cores.
template <typename Visit>
void visitPixels(std::size_t count, const Visit& visit)
{
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        visit(i);
      }
    });
}

} // namespace

//------------------------------------------------------------------------------
Certainty certaintyOf(PixelClass of)
{
  switch (of)
  {
    case PixelClass::Background:
    case PixelClass::OutsideLit:
    case PixelClass::HintedLit:
    case PixelClass::LeftLit:
    case PixelClass::MajorityLit:
      return Certainty::Lit;
    case PixelClass::TurnedAway:
    case PixelClass::OutsideShadow:
    case PixelClass::HintedShadow:
    case PixelClass::ConfirmedByTexel:
    case PixelClass::ConfirmedByNeighbours:
    case PixelClass::ConfirmedByAdjacency:
    case PixelClass::Corrected:
    case PixelClass::MajorityShadow:
      return Certainty::Shadow;
    case PixelClass::TracedLit:
    case PixelClass::TracedShadow:
      break;
  }
  return Certainty::Uncertain;
}

/// A chain for lights whose rays are made in one way.
template <typename MakeRay>
class Chain::OfLight
{
public:
  OfLight(const Chain& chain, const MakeRay& makeRay, float rayFar)
    : chain_(chain)
    , makeRay_(makeRay)
    , rayFar_(rayFar)
  {
  }

  std::vector<PixelClass> classes() const
  {
    const ReceiverPixels& receivers = this->chain_.receivers_;
    const int radius = this->chain_.stages_.contourPixels / 2;
    std::vector<std::uint8_t> contour(radius > 0 ? 0 : receivers.size(), 1);
    if (radius > 0)
    {
      std::vector<PixelStatus> statuses(receivers.size());
      visitPixels(receivers.size(), [&](std::size_t i) { statuses[i] = this->statusOf(i); });
      contour = contourOf(statuses, receivers.width, receivers.height, radius);
    }
    std::vector<PixelClass> classes(receivers.size());
    visitPixels(
      receivers.size(), [&](std::size_t i) { classes[i] = this->classOf(i, contour[i] != 0); });
    return classes;
  }

private:
  bool receives(std::size_t pixel) const
  {
    const std::uint32_t surface = this->chain_.receivers_.surface[pixel];
    return surface != ReceiverPixels::notCovered &&
      this->chain_.occluders_.surfaces[surface].receives;
  }

  glm::vec3 normalOf(std::size_t pixel) const
  {
    const ReceiverPixels& of = this->chain_.receivers_;
    return { of.normalX[pixel], of.normalY[pixel], of.normalZ[pixel] };
  }

  ShadowRay rayOf(std::size_t pixel) const
  {
    const ReceiverPixels& of = this->chain_.receivers_;
    const glm::vec3 position(of.positionX[pixel], of.positionY[pixel], of.positionZ[pixel]);
    return this->makeRay_(position, this->normalOf(pixel), of.offset[pixel]);
  }

  std::optional<PlaceOnMaps> placeOf(const ShadowRay& ray, std::size_t pixel) const
  {
    return this->chain_.maps_.find(ray.origin, this->normalOf(pixel));
  }

  PixelStatus statusOf(std::size_t pixel) const
  {
    if (!this->receives(pixel))
    {
      return PixelStatus::None;
    }
    const ShadowRay ray = this->rayOf(pixel);
    if (!ray.traced)
    {
      return PixelStatus::Shadow;
    }
    const std::optional<PlaceOnMaps> place = this->placeOf(ray, pixel);
    return place && place->shadows() ? PixelStatus::Shadow : PixelStatus::Lit;
  }

  PixelClass classOf(std::size_t pixel, bool inContour) const
  {
    const ChainStages& stages = this->chain_.stages_;
    if (!this->receives(pixel))
    {
      return PixelClass::Background;
    }
    const ShadowRay ray = this->rayOf(pixel);
    if (!ray.traced)
    {
      return PixelClass::TurnedAway;
    }
    const std::optional<PlaceOnMaps> place = this->placeOf(ray, pixel);
    const bool inShadow = place && place->shadows();
    const bool joins = inContour ||
      (stages.outside == OutsideContour::Check && place && !place->agree(Neighbourhood::Nine));
    if (!joins)
    {
      return inShadow ? PixelClass::OutsideShadow : PixelClass::OutsideLit;
    }
    if (stages.coherenceTexels > 0 &&
      (!place || place->agree(neighbourhoodOf(stages.coherenceTexels))))
    {
      return inShadow ? PixelClass::HintedShadow : PixelClass::HintedLit;
    }
    if (const std::optional<PixelClass> proven =
          place ? this->proof(ray, *place, inShadow) : std::nullopt)
    {
      return *proven;
    }
    switch (stages.leftovers)
    {
      case Leftovers::Lit:
        return PixelClass::LeftLit;
      case Leftovers::Majority:
        return place && place->votes() > 4 ? PixelClass::MajorityShadow : PixelClass::MajorityLit;
      case Leftovers::Trace:
        break;
    }
    return inShadow ? PixelClass::TracedShadow : PixelClass::TracedLit;
  }

  /// What proves that a pixel is in shadow, if anything does.
  /// @param inShadow the status by the map
  std::optional<PixelClass> proof(
    const ShadowRay& ray, const PlaceOnMaps& place, bool inShadow) const
  {
    const ChainStages& stages = this->chain_.stages_;
    const Occluders& occluders = this->chain_.occluders_;
    const auto stops = [&](const CasterTriangle& caster)
    { return certainlyStops(occluders, caster, ray, this->rayFar_); };

    std::array<CasterTriangle, 9> tested;
    std::size_t count = 0;
    const auto isNew = [&](const CasterTriangle& caster)
    { return std::find(tested.begin(), tested.begin() + count, caster) == tested.begin() + count; };
    std::size_t texels = 0;
    const bool hit = stages.neighbourTexels > 0 &&
      visitNeighbourhood(neighbourhoodOf(stages.neighbourTexels), place.place,
        [&](int column, int row)
        {
          ++texels;
          const CasterTriangle& caster = place.map->texel(column, row).caster;
          return caster.exists() && isNew(caster) && stops(tested[count++] = caster);
        });
    if (hit)
    {
      return !inShadow ? PixelClass::Corrected
        : texels == 1  ? PixelClass::ConfirmedByTexel
                       : PixelClass::ConfirmedByNeighbours;
    }
    if (inShadow && stages.adjacency != Adjacency::Off)
    {
      CasterTriangle caster = place.map->texel(place.place.column, place.place.row).caster;
      const bool adjacent =
        visitAdjacent(this->chain_.fans_.of(caster.surface), caster.triangle, stages.adjacency,
          [&](std::uint32_t triangle)
          {
            caster.triangle = triangle;
            return stops(caster);
          });
      if (adjacent)
      {
        return PixelClass::ConfirmedByAdjacency;
      }
    }
    return std::nullopt;
  }

  const Chain& chain_;
  const MakeRay& makeRay_;
  float rayFar_;
};

//------------------------------------------------------------------------------
Chain::Chain(const ChainStages& stages, const TriangleMaps& maps, const TriangleFans& fans,
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
  : stages_(stages)
  , maps_(maps)
  , fans_(fans)
  , light_(light)
  , occluders_(occluders)
  , receivers_(receivers)
{
}

//------------------------------------------------------------------------------
std::vector<PixelClass> Chain::classes() const
{
  const ShadowRayLight rayLight(this->light_, this->occluders_.centreWorld);
  return visitShadowRays(rayLight,
    [this](const auto& makeRay, float rayFar)
    { return OfLight<std::decay_t<decltype(makeRay)>>(*this, makeRay, rayFar).classes(); });
}

} // namespace gnomon
