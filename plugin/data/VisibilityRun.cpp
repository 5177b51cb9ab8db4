#include "plugin/data/VisibilityRun.h"

#include "plugin/data/VisibilityTile.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace gnomon
{
namespace
{

/// Samples of a chunk, at least one element's.
constexpr std::size_t samplesOfChunk = 16384;
/// Samples of a tile, which one thread traces. Four packets, so that few packets are incomplete.
constexpr std::size_t samplesOfTile = 64;
/// Answers that a tile holds at a time: they fit the processor's first cache.
constexpr std::size_t answersOfTile = 16384;

/// Return a position on a Z curve over all directions. Octahedral coordinates map directions onto a
/// square (Meyer et al., EGSR 2010).
std::uint32_t placeOf(const glm::vec3& direction)
{
  const glm::vec3 size = glm::abs(direction);
  glm::vec2 at = glm::vec2(direction) / (size.x + size.y + size.z); // a unit vector has a length
  if (direction.z < 0.0f)
  {
    const glm::vec2 folded(1.0f - std::abs(at.y), 1.0f - std::abs(at.x));
    at = { std::copysign(folded.x, at.x), std::copysign(folded.y, at.y) };
  }
  const auto spread = [](float coordinate)
  {
    auto bits =
      static_cast<std::uint32_t>(glm::clamp(0.5f + 0.5f * coordinate, 0.0f, 1.0f) * 65535.0f);
    bits = (bits | bits << 8) & 0x00ff00ffu;
    bits = (bits | bits << 4) & 0x0f0f0f0fu;
    bits = (bits | bits << 2) & 0x33333333u;
    return (bits | bits << 1) & 0x55555555u;
  };
  return spread(at.x) | spread(at.y) << 1;
}

/// After all directions.
constexpr std::uint64_t placeOfLamps = std::uint64_t(1) << 32;

/// True if any of a direction's disc is above the ground.
bool mayShine(const WeightedLight& light, const glm::vec3& up)
{
  const float reach = glm::length(glm::vec2(glm::dot(up, light.discX), glm::dot(up, light.discY)));
  return isAboveGround(up, light.ray.toLight + 2.0f * reach * up);
}

} // namespace

VisibilityRun::VisibilityRun(const DataScene& scene, const ReceiverStarts& starts,
  const EmbreeTracer& tracer, Plan plan, const VisibilityArrays& arrays)
  : scene_(scene)
  , receivers_(starts)
  , tracer_(tracer)
  , plan_(std::move(plan))
  , arrays_(arrays)
  , order_(starts.order())
  , bytesOfBits_((plan_.lights.size() + 7) / 8)
  , samplesOfElement_(static_cast<std::size_t>(starts.samples()))
{
  for (const WeightedLight& light : this->plan_.lights)
  {
    this->allHours_ += light.weight;
  }
  this->orderLights();
}

/// Sort directions along the curve, then append the lights that have a position. Directions below
/// the horizon are left out.
void VisibilityRun::orderLights()
{
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  for (std::size_t i = 0; i < this->plan_.lights.size(); ++i)
  {
    const ShadowRayLight& light = this->plan_.lights[i].ray;
    if (isPlain(light) && !mayShine(this->plan_.lights[i], this->plan_.up))
    {
      continue;
    }
    keyed.emplace_back(
      isPlain(light) ? placeOf(light.toLight) : placeOfLamps, static_cast<std::uint32_t>(i));
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<WeightedLight> lights;
  for (const auto& [place, number] : keyed)
  {
    lights.push_back(this->plan_.lights[number]);
    this->numberOfLight_.push_back(number);
  }
  this->explained_.emplace(this->plan_.lights[this->plan_.explained].ray);
  this->plan_.lights = std::move(lights);
}

std::size_t VisibilityRun::chunkSize() const
{
  return std::max<std::size_t>(
    1, samplesOfChunk / static_cast<std::size_t>(this->receivers_.samples()));
}

double VisibilityRun::shareDone() const
{
  // No lights remain if all are below the horizon.
  const auto lights = static_cast<double>(std::max<std::size_t>(1, this->plan_.lights.size()));
  const auto inChunk = static_cast<double>(this->chunkEnd_ - this->chunkBegin_);
  const double done = static_cast<double>(this->chunkBegin_) +
    (this->chunkBegun_ ? inChunk * static_cast<double>(this->nextLight_) / lights : 0.0);
  return this->order_.empty() ? 1.0 : done / static_cast<double>(this->order_.size());
}

bool VisibilityRun::go(const std::function<bool(double)>& goOn)
{
  while (this->chunkBegin_ < this->order_.size())
  {
    if (!this->chunkBegun_)
    {
      this->beginChunk();
    }
    const std::size_t block = std::max(VisibilityTile::lightsOfGroup,
      raysOfPart / this->hours_.size() / VisibilityTile::lightsOfGroup *
        VisibilityTile::lightsOfGroup);
    const std::size_t lastLight = std::min(this->nextLight_ + block, this->plan_.lights.size());
    this->traceBlock(this->nextLight_, lastLight);
    this->nextLight_ = lastLight;
    if (this->nextLight_ == this->plan_.lights.size())
    {
      this->explain();
      this->finishChunk();
    }
    if (!goOn(this->shareDone()) && this->chunkBegin_ < this->order_.size())
    {
      return false;
    }
  }
  return true;
}

void VisibilityRun::beginChunk()
{
  this->chunkBegun_ = true;
  this->nextLight_ = 0;
  this->chunkEnd_ = std::min(this->chunkBegin_ + this->chunkSize(), this->order_.size());
  this->hours_.assign((this->chunkEnd_ - this->chunkBegin_) * this->samplesOfElement_, 0.0);
}

void VisibilityRun::traceBlock(std::size_t firstLight, std::size_t lastLight)
{
  const std::size_t elements = this->chunkEnd_ - this->chunkBegin_;
  const std::size_t ofTile = std::max<std::size_t>(1, samplesOfTile / this->samplesOfElement_);
  const std::size_t tiles = (elements + ofTile - 1) / ofTile;
  std::atomic<std::uint64_t> rays{ 0 };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles, 1),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t tile = range.begin(); tile != range.end(); ++tile)
      {
        rays += this->traceTile(
          tile * ofTile, std::min((tile + 1) * ofTile, elements), firstLight, lastLight);
      }
    });
  this->rays_ += rays;
}

/// Trace a tile.
/// @param firstElement, lastElement counted from the chunk's first
/// @return the number of rays
std::uint64_t VisibilityRun::traceTile(
  std::size_t firstElement, std::size_t lastElement, std::size_t firstLight, std::size_t lastLight)
{
  SampleStarts starts;
  starts.clear();
  for (std::size_t e = firstElement; e < lastElement; ++e)
  {
    this->receivers_.append(this->order_[this->chunkBegin_ + e], starts);
  }
  const std::size_t firstSample = firstElement * this->samplesOfElement_;
  const std::size_t samples = starts.samples();
  const std::size_t lightsAtOnce = std::max(VisibilityTile::lightsOfGroup,
    answersOfTile / samples / VisibilityTile::lightsOfGroup * VisibilityTile::lightsOfGroup);
  std::vector<std::uint8_t> lit(samples * std::min(lightsAtOnce, lastLight - firstLight));
  VisibilityTile tile(this->plan_, this->tracer_, starts, lit.data());

  for (std::size_t begin = firstLight; begin < lastLight; begin += lightsAtOnce)
  {
    const std::size_t end = std::min(begin + lightsAtOnce, lastLight);
    std::fill(lit.begin(), lit.end(), std::uint8_t(0));
    for (std::size_t group = begin; group < end; group += VisibilityTile::lightsOfGroup)
    {
      tile.trace(
        group, std::min(group + VisibilityTile::lightsOfGroup, end), (group - begin) * samples);
    }
    tile.flush();

    for (std::size_t light = begin; light < end; ++light)
    {
      const std::uint8_t* const answers = &lit[(light - begin) * samples];
      const double weight = this->plan_.lights[light].weight;
      double* const hours = &this->hours_[firstSample];
      for (std::size_t s = 0; s < samples; ++s)
      {
        hours[s] += answers[s] != 0 ? weight : 0.0;
      }
      const std::uint32_t number = this->numberOfLight_[light];
      for (std::size_t e = firstElement; this->arrays_.bits && e < lastElement; ++e)
      {
        const std::uint8_t* const own = answers + (e - firstElement) * this->samplesOfElement_;
        std::size_t count = 0;
        for (std::size_t s = 0; s < this->samplesOfElement_; ++s)
        {
          count += own[s];
        }
        if (2 * count >= this->samplesOfElement_)
        {
          this->arrays_
            .bits[this->order_[this->chunkBegin_ + e] * this->bytesOfBits_ + number / 8] |=
            static_cast<std::uint8_t>(1u << number % 8);
        }
      }
    }
  }
  return tile.rays();
}

void VisibilityRun::explain()
{
  if (!this->arrays_.fate && !this->arrays_.blockerCell && !this->arrays_.blockerInput)
  {
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(this->chunkBegin_, this->chunkEnd_, 64),
    [this](const tbb::blocked_range<std::size_t>& range)
    {
      SampleStarts starts; // their memory is shared
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        this->explainOne(this->order_[i], starts);
      }
    });
}

/// Explain the fate of the element's middle. A point has the fate of its start that is nearest to
/// being lit. A start that faces the light precedes one that does not.
void VisibilityRun::explainOne(std::size_t element, SampleStarts& starts) const
{
  starts.clear();
  this->receivers_.append(element, starts, true);
  const ShadowRayLight& light = *this->explained_;
  Fate fate = Fate::TurnedAway;
  vtkIdType cell = -1;
  int input = -1;
  if (light.kind == LightKind::Directional && !isAboveGround(this->plan_.up, light.toLight))
  {
    fate = Fate::BelowHorizon;
  }
  for (std::size_t i = 0;
       fate != Fate::BelowHorizon && fate != Fate::Lit && i < starts.position.size(); ++i)
  {
    visitShadowRays(light,
      [&](const auto& makeRay, float rayFar)
      {
        const ShadowRay ray = rayOf(makeRay, RayStart(starts, i), this->plan_.bothSides);
        if (!ray.traced)
        {
          // Turned away, or outside the cone or box of a light that it faces.
          const bool faces = facesLight(starts.normal[i], ray.direction) ||
            (this->plan_.bothSides && facesLight(-starts.normal[i], ray.direction));
          fate = fate == Fate::TurnedAway && faces ? Fate::OutOfReach : fate;
          return;
        }
        std::uint8_t blocked = 0;
        this->tracer_.areBlocked(1, { &ray.origin.x, &ray.origin.y, &ray.origin.z },
          { &ray.direction.x, &ray.direction.y, &ray.direction.z }, rayFar, &blocked);
        if (blocked == 0)
        {
          fate = Fate::Lit;
          cell = -1;
          input = -1;
          return;
        }
        if (fate == Fate::BlockedBySelf || fate == Fate::BlockedByOther)
        {
          return;
        }
        // A ray within rounding of an edge may be blocked by a triangle that a single ray misses.
        const std::optional<CasterHits::Hit> hit =
          this->tracer_.nearest(ray.origin, ray.direction, shadowRayNear, rayFar);
        input = hit ? this->scene_.inputOf(hit->surface) : -1;
        cell = hit ? this->scene_.cellOf(hit->surface, hit->triangle) : -1;
        fate = input == 0 ? Fate::BlockedBySelf : Fate::BlockedByOther;
      });
  }
  const auto set = [&](auto* array, auto value)
  {
    if (array)
    {
      array[element] = value;
    }
  };
  set(this->arrays_.fate, static_cast<std::uint8_t>(fate));
  set(this->arrays_.blockerCell, cell);
  set(this->arrays_.blockerInput, input);
}

void VisibilityRun::finishChunk()
{
  const auto samples = static_cast<double>(this->samplesOfElement_);
  // Lights that are on for no time leave nothing lit.
  const double toFraction = this->allHours_ > 0.0 ? 1.0 / this->allHours_ : 0.0;
  for (std::size_t i = this->chunkBegin_; i < this->chunkEnd_; ++i)
  {
    const double* const own = &this->hours_[(i - this->chunkBegin_) * this->samplesOfElement_];
    double sum = 0.0;
    for (std::size_t s = 0; s < this->samplesOfElement_; ++s)
    {
      sum += own[s];
    }
    const double mean = sum / samples;
    double squares = 0.0;
    for (std::size_t s = 0; s < this->samplesOfElement_; ++s)
    {
      squares += (own[s] - mean) * (own[s] - mean);
    }
    const std::uint32_t element = this->order_[i];
    if (this->arrays_.hours)
    {
      this->arrays_.hours[element] = static_cast<float>(mean);
    }
    if (this->arrays_.fraction)
    {
      this->arrays_.fraction[element] = static_cast<float>(mean * toFraction);
    }
    if (this->arrays_.error)
    {
      this->arrays_.error[element] = this->samplesOfElement_ > 1
        ? static_cast<float>(std::sqrt(squares / (samples - 1.0) / samples) * toFraction)
        : 0.0f;
    }
  }
  this->chunkBegin_ = this->chunkEnd_;
  this->chunkBegun_ = false;
  this->nextLight_ = 0;
}

} // namespace gnomon
