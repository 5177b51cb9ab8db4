#pragma once

#include "plugin/data/ReceiverStarts.h"
#include "plugin/data/VisibilityRun.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Rays of one length that wait for the tracer, with the places of their answers.
class WaitingRays
{
public:
  WaitingRays(const EmbreeTracer& tracer, std::uint8_t* lit)
    : tracer_(tracer)
    , lit_(lit)
  {
  }
  void setFar(float rayFar)
  {
    if (rayFar != this->rayFar_)
    {
      this->flush();
      this->rayFar_ = rayFar;
    }
  }
  /// @param answer place in `lit`, set to 1 if the ray is free
  void add(const ShadowRay& ray, std::size_t answer)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->origins_[static_cast<std::size_t>(axis)][this->count_] = ray.origin[axis];
      this->directions_[static_cast<std::size_t>(axis)][this->count_] = ray.direction[axis];
    }
    this->answers_[this->count_] = static_cast<std::uint32_t>(answer);
    if (++this->count_ == raysOfBatch)
    {
      this->flush();
    }
  }
  void flush()
  {
    const auto arrays = [](const std::array<std::array<float, raysOfBatch>, 3>& of) {
      return PointArrays{ of[0].data(), of[1].data(), of[2].data() };
    };
    this->tracer_.areBlocked(this->count_, arrays(this->origins_), arrays(this->directions_),
      this->rayFar_, this->blocked_.data());
    for (std::size_t i = 0; i < this->count_; ++i)
    {
      this->lit_[this->answers_[i]] |= static_cast<std::uint8_t>(1 - this->blocked_[i]);
    }
    this->rays_ += this->count_;
    this->count_ = 0;
  }
  std::uint64_t rays() const { return this->rays_; }

private:
  static constexpr std::size_t raysOfBatch = 256; ///< traced in one call

  const EmbreeTracer& tracer_;
  std::uint8_t* lit_;
  float rayFar_ = shadowRayFarDirectional;
  std::size_t count_ = 0;
  std::uint64_t rays_ = 0;
  std::array<std::array<float, raysOfBatch>, 3> origins_;
  std::array<std::array<float, raysOfBatch>, 3> directions_;
  std::array<std::uint32_t, raysOfBatch> answers_;
  std::array<std::uint8_t, raysOfBatch> blocked_;
};

/// A copy of a start, which the compiler holds in registers while rays are stored.
struct RayStart
{
  glm::vec3 position;
  glm::vec3 normal;
  float offset;

  RayStart(const SampleStarts& starts, std::size_t i)
    : position(starts.position[i])
    , normal(starts.normal[i])
    , offset(starts.offset[i])
  {
  }
};

/// Return the shadow ray of a start. If it receives on both sides, use the side that faces the
/// light.
template <typename MakeRay>
ShadowRay rayOf(const MakeRay& makeRay, const RayStart& start, bool bothSides)
{
  if (!bothSides) // this path copies no ray
  {
    return makeRay(start.position, start.normal, start.offset);
  }
  const ShadowRay ray = makeRay(start.position, start.normal, start.offset);
  return ray.traced ? ray : makeRay(start.position, -start.normal, start.offset);
}

inline bool isAboveGround(const glm::vec3& up, const glm::vec3& toLight)
{
  return up == glm::vec3(0.0f) || glm::dot(up, toLight) > 0.0f;
}

/// True if all rays to a light are parallel and endless.
inline bool isPlain(const ShadowRayLight& light)
{
  return light.kind == LightKind::Directional && !light.hasBox;
}

/// Traces rays from some samples to a group of lights.
class VisibilityTile
{
public:
  /// Consecutive lights whose rays from a sample are adjacent: the number of lanes of a packet.
  static constexpr std::size_t lightsOfGroup = 16;

  /// @param starts of the samples
  /// @param lit receives the answers of `samples` samples to each light, one light after the other
  VisibilityTile(const VisibilityRun::Plan& plan, const EmbreeTracer& tracer,
    const SampleStarts& starts, std::uint8_t* lit)
    : plan_(plan)
    , starts_(starts)
    , samples_(starts.samples())
    , batch_(tracer, lit)
    , lit_(lit)
    , next_(lightsOfGroup * starts.samples())
  {
  }

  /// @param answers index of the first light's answers in `lit`
  void trace(std::size_t firstLight, std::size_t lastLight, std::size_t answers)
  {
    const bool isSimple = this->starts_.position.size() == this->samples_ &&
      this->starts_.disc.empty() && isPlain(this->plan_.lights[lastLight - 1].ray);
    isSimple ? this->traceSimple(firstLight, lastLight, answers)
             : this->traceAny(firstLight, lastLight, answers);
  }
  void flush() { this->batch_.flush(); }
  std::uint64_t rays() const { return this->batch_.rays(); }

private:
  /// Trace samples with one start to directions without a disc.
  void traceSimple(std::size_t firstLight, std::size_t lastLight, std::size_t answers)
  {
    this->batch_.setFar(shadowRayFarDirectional);
    const bool bothSides = this->plan_.bothSides;
    for (std::size_t s = 0; s < this->samples_; ++s)
    {
      const RayStart start(this->starts_, s);
      std::size_t answer = answers + s;
      for (std::size_t light = firstLight; light < lastLight; ++light, answer += this->samples_)
      {
        const ShadowRayLight& to = this->plan_.lights[light].ray;
        const ShadowRay ray = rayOf(
          [&to](const auto&... of) { return shadowRayDirectional(to, of...); }, start, bothSides);
        if (ray.traced)
        {
          this->batch_.add(ray, answer);
        }
      }
    }
  }

  void traceAny(std::size_t firstLight, std::size_t lastLight, std::size_t answers)
  {
    for (std::size_t light = firstLight; light < lastLight; ++light)
    {
      const auto next =
        this->next_.begin() + static_cast<std::ptrdiff_t>((light - firstLight) * this->samples_);
      std::copy_n(this->starts_.first.begin(), this->samples_, next);
    }
    // After a lit start, a sample's further starts need no ray.
    for (bool waits = true; waits;)
    {
      waits = false;
      for (std::size_t s = 0; s < this->samples_; ++s)
      {
        for (std::size_t light = firstLight; light < lastLight; ++light)
        {
          const std::size_t place = (light - firstLight) * this->samples_ + s;
          waits |= this->addRay(this->plan_.lights[light], s, this->next_[place], answers + place);
        }
      }
      if (waits)
      {
        this->batch_.flush();
      }
    }
  }
  /// Add the ray from the next start of a sample that faces a light.
  /// @return true if the sample has starts left
  bool addRay(
    const WeightedLight& light, std::size_t sample, std::uint32_t& next, std::size_t answer)
  {
    const std::uint32_t last = this->starts_.first[sample + 1];
    if (next == last || this->lit_[answer] != 0)
    {
      return false;
    }
    if (!isPlain(light.ray) || this->starts_.disc.empty())
    {
      return this->addRayTo(light.ray, last, next, answer);
    }
    const glm::vec2& at = this->starts_.disc[sample];
    ShadowRayLight seen = light.ray;
    seen.toLight += at.x * light.discX + at.y * light.discY;
    return isAboveGround(this->plan_.up, seen.toLight) && this->addRayTo(seen, last, next, answer);
  }

  bool addRayTo(
    const ShadowRayLight& light, std::uint32_t last, std::uint32_t& next, std::size_t answer)
  {
    return visitShadowRays(light,
      [&](const auto& makeRay, float rayFar)
      {
        while (next < last)
        {
          const ShadowRay ray =
            rayOf(makeRay, RayStart(this->starts_, next++), this->plan_.bothSides);
          if (ray.traced)
          {
            this->batch_.setFar(rayFar);
            this->batch_.add(ray, answer);
            break;
          }
        }
        return next < last;
      });
  }

  const VisibilityRun::Plan& plan_;
  const SampleStarts& starts_;
  std::size_t samples_;
  WaitingRays batch_;
  const std::uint8_t* lit_;
  std::vector<std::uint32_t> next_; ///< start of each sample, for each light of the group
};

} // namespace gnomon
