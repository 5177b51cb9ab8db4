#pragma once

#include "lights/CameraView.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PixelRays.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/probing/ProbeCounts.h"
#include "shadowtech/tracing/CasterHits.h"
#include "shadowtech/tracing/EmbreeTracer.h"
#include "shadowtech/tracing/SeenReceiver.h"

#include <glm/glm.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace gnomon
{

struct Occluders;
class ShaderLibrary;
class EmbreeTracer;

/// Compares a cheap visibility with traced visibility at some pixels, before the picture is drawn.
/// Camera rays find the receivers. They miss surfaces that do not cast, and hit the surface behind.
class Probes
{
public:
  static constexpr int across = 64; ///< parts along each side of the picture
  static constexpr std::size_t count = probesOfALook;
  static_assert(count == std::size_t(across) * across);

  /// Find the points, as many in each part of the picture that is aimed at.
  /// @param number another number moves the points within their parts
  void look(const CameraView& camera, const glm::ivec2& sizePixels, const Occluders& occluders,
    const CasterHits& hits, std::uint32_t number)
  {
    const PixelRays rays = pixelRays(
      camera.clipFromView, glm::inverse(camera.viewFromCentred), sizePixels.x, sizePixels.y);
    const glm::dvec2 pixelSide = camera.pixelSide(sizePixels);
    const glm::dvec3 eyeCentred = camera.eyeCentred();
    const glm::dvec3 lookCentred = camera.directionCentred();
    const glm::dvec2 moved(spread(number, 0.7548776662466927), spread(number, 0.5698402909980532));
    const std::size_t partCount = this->parts_.empty() ? count : this->parts_.size();
    // In lengths of the direction, which are distances across the view (PixelRays).
    const auto nearest = static_cast<float>(camera.nearDistance());
    const auto farthest = static_cast<float>(camera.farDistance());
    this->receivers_.resize(across, across);
    const auto lookAt = [&](std::size_t i)
    {
      const glm::dvec2 part(this->partOf(i) % across, this->partOf(i) / across);
      // Points of one part are spread by steps that no look has.
      const std::size_t inPart = i / partCount;
      const glm::dvec2 within = glm::fract(
        moved + glm::dvec2(spread(inPart, 0.6180339887498949), spread(inPart, 0.4142135623730950)));
      const glm::dvec2 pixel =
        glm::floor((part + within) / static_cast<double>(across) * glm::dvec2(sizePixels));
      const glm::dvec3 origin = rays.origin(pixel.x, pixel.y);
      const glm::dvec3 direction = rays.direction(pixel.x, pixel.y);
      const std::optional<CasterHits::Hit> hit =
        hits.nearest(glm::vec3(origin), glm::vec3(direction), nearest, farthest);
      this->receivers_.surface[i] = ReceiverPixels::notCovered;
      this->receivers_.curved[i] = 0;
      this->receivers_.offset[i] = 0.0f;
      if (!hit || !occluders.surfaces[hit->surface].receives)
      {
        return;
      }
      const SeenReceiver seen = seenReceiver(*hit, origin, direction, eyeCentred);
      const double depth = glm::dot(glm::dvec3(seen.position) - eyeCentred, lookCentred);
      this->receivers_.put(i, seen.position, seen.normal,
        shadowRayOffset(seen.noise, static_cast<float>(pixelSide.x + pixelSide.y * depth)),
        hit->surface);
    };
    tbb::parallel_for(std::size_t(0), count, lookAt);
  }

  /// Count the points where a map is wrong.
  /// @param technique its map is baked
  /// @param tracer its structure is up to date with the occluders
  WrongProbes wrongOf(const PointwiseTechnique& technique, const ShadowLight& light,
    const ReceiverSpace& space, const Occluders& occluders, EmbreeTracer& tracer,
    ShaderLibrary& shaders)
  {
    std::vector<glm::vec4> fragments(count, glm::vec4(0.0f));
    std::vector<glm::vec4> points(count, glm::vec4(0.0f));
    const glm::dmat4 viewFromCentred = glm::inverse(space.centredFromView);
    for (std::size_t i = 0; i < count; ++i)
    {
      if (this->receivers_.surface[i] != ReceiverPixels::notCovered)
      {
        const glm::dvec4 position(this->receivers_.position(i), 1.0);
        const glm::dvec4 normal(this->receivers_.normal(i), 0.0);
        const glm::vec3 positionView(viewFromCentred * position);
        const glm::vec3 normalView(viewFromCentred * normal);
        fragments[i] = glm::vec4(1.0f, 0.0f, normalView.x, normalView.y);
        points[i] = glm::vec4(positionView, normalView.z);
      }
    }
    this->target_.fill(across, across, fragments, points);
    this->layers_.resize(across, across, 1, 0);
    this->layers_.estimate(0, technique, light, this->target_, space, shaders);
    this->layers_.read(0, this->asked_);
    tracer.trace(
      light, occluders, Receivers(this->receivers_), this->traced_, nullptr, &this->classes_);

    WrongProbes probes;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (this->classes_[i] == static_cast<std::uint8_t>(TracedClass::Traced))
      {
        ++probes.asked;
        probes.wrong += std::abs(this->asked_[i] - this->traced_[i]) > 0.5f ? 1 : 0;
      }
    }
    return probes;
  }

  /// Aim further looks at all 64 x 64 parts of the picture, one point in each.
  void aimEverywhere() { this->parts_.clear(); }

  /// Aim further looks at the parts where wrongOf() found a point that faces the light (at least
  /// one), and at their neighbours. More points then face the light. They miss what is small and
  /// apart from all points found.
  void aimAtFacing()
  {
    std::set<std::size_t> aimed;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (this->classes_[i] == static_cast<std::uint8_t>(TracedClass::Traced))
      {
        const int x = static_cast<int>(this->partOf(i) % across);
        const int y = static_cast<int>(this->partOf(i) / across);
        for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, across - 1); ++ny)
        {
          for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, across - 1); ++nx)
          {
            aimed.insert(static_cast<std::size_t>(ny) * across + static_cast<std::size_t>(nx));
          }
        }
      }
    }
    this->parts_.assign(aimed.begin(), aimed.end());
  }

  /// Sum up the errors of an area light's visibility if it is traced from another light.
  /// @param other the light with fewer samples, compared at every fourth point; or without its
  /// area, compared at all points by 16 samples
  SquaredErrors errorsOf(const ShadowLight& other, const ShadowLight& light,
    const Occluders& occluders, EmbreeTracer& tracer)
  {
    // So many rays to each point show the small error of few samples. The larger one of a hard
    // shadow takes fewer, so that more points can be asked.
    const bool isHard = !other.area;
    const std::size_t step = isHard ? 1 : 2;
    ShadowLight truth = light;
    truth.lightSamples = isHard ? std::min(light.lightSamples, 16) : light.lightSamples;
    ReceiverPixels some = this->receivers_;
    for (std::size_t i = 0; i < count; ++i)
    {
      const bool isTaken = i % step == 0 && i / across % step == 0;
      some.surface[i] = isTaken ? some.surface[i] : ReceiverPixels::notCovered;
    }
    const Receivers receivers(some);
    tracer.traceArea(truth, occluders, receivers, this->traced_, nullptr, &this->classes_);
    isHard ? tracer.trace(other, occluders, receivers, this->asked_)
           : tracer.traceArea(other, occluders, receivers, this->asked_);
    SquaredErrors errors;
    // The mean over a penumbra that darkens evenly, half of which is lit; or the variance of
    // independent samples, half of which are hidden.
    errors.expected = isHard ? 1.0 / 12.0 : 0.25 / other.lightSamples;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (this->classes_[i] == static_cast<std::uint8_t>(TracedClass::Traced))
      {
        double squares = 0.0;
        for (std::size_t at = i; at < this->traced_.size(); at += count)
        {
          const auto off = static_cast<double>(this->asked_[at] - this->traced_[at]);
          squares += off * off;
        }
        const double mean = squares * count / static_cast<double>(this->traced_.size());
        errors.add({ 1, mean, mean * mean });
      }
    }
    return errors;
  }

  std::size_t bytes() const
  {
    return this->receivers_.bytes() + this->target_.bytes() + this->layers_.bytes() +
      bytesOf(this->traced_) + bytesOf(this->asked_) + bytesOf(this->classes_) +
      bytesOf(this->parts_);
  }

private:
  /// Return element `number` of a sequence spread evenly over [0, 1) (Roberts 2018).
  static double spread(std::size_t number, double step)
  {
    const double value = number * step;
    return value - std::floor(value);
  }

  std::size_t partOf(std::size_t point) const
  {
    return this->parts_.empty() ? point : this->parts_[point % this->parts_.size()];
  }

  std::vector<std::size_t> parts_; ///< aimed at; empty: all
  ReceiverPixels receivers_;
  ReceiverTarget target_;
  VisibilityLayers layers_;
  std::vector<float> traced_, asked_;
  std::vector<std::uint8_t> classes_;
};

} // namespace gnomon
