#pragma once

#include "plugin/data/DataScene.h"
#include "plugin/data/ReceiverStarts.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include "vtkType.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace gnomon
{

/// Approximate rays of a part: a twentieth of a second on two cores. An abort waits for its end.
inline constexpr std::size_t raysOfPart = std::size_t(1) << 20;

/// A light, or the sun at one of its positions.
struct WeightedLight
{
  ShadowRayLight ray;
  double weight; ///< hours
  /// Two vectors across the way to the light, at the distance of `ray.toLight`. They map the unit
  /// disc to the light's disc as the scene sees it. 0 for a point.
  glm::vec3 discX{ 0.0f };
  glm::vec3 discY{ 0.0f };
};

/// The fate of a shadow ray. The numbers are public (vtkGnomonVisibilityFilter).
enum class Fate : std::uint8_t
{
  Lit = 0,
  BlockedBySelf = 1,
  BlockedByOther = 2,
  TurnedAway = 3,
  BelowHorizon = 4,
  OutOfReach = 5,
  NoSurface = 6
};

/// Destinations of the results, one entry for each element, filled with the value for no surface.
/// Null: not wanted.
struct VisibilityArrays
{
  float* hours;
  float* fraction;
  float* error;       ///< standard error of the fraction
  std::uint8_t* bits; ///< bit d % 8 of byte d / 8 of an element: 1 if light d reaches it
  std::uint8_t* fate; ///< of the explained light
  vtkIdType* blockerCell;
  int* blockerInput;
};

/// Traces the shadow rays from elements to lights in parts, so that it can pause between them. Its
/// results depend neither on the parts nor on threads.
///
/// It visits elements chunk by chunk, and for each chunk all lights block by block, so memory
/// depends on neither number. Packets hold the rays of one sample to consecutive lights or, with
/// few lights, the rays of neighbouring samples.
class VisibilityRun
{
public:
  struct Plan
  {
    std::vector<WeightedLight> lights;
    glm::vec3 up{ 0.0f };      ///< unit; anything not above the ground is dark. 0: no ground
    std::size_t explained = 0; ///< the light whose fates are explained
    bool bothSides = false;    ///< elements receive on the side that faces the light
  };

  /// @param scene, starts, tracer, arrays must outlive this
  /// @param tracer has the scene's snapshot
  VisibilityRun(const DataScene& scene, const ReceiverStarts& starts, const EmbreeTracer& tracer,
    Plan plan, const VisibilityArrays& arrays);

  /// Continue until all is done or goOn() returns false.
  /// @param goOn called with the completed share, in [0, 1], after each part; false: stop
  /// @return true if all is done
  bool go(const std::function<bool(double)>& goOn);

  /// Return the number of rays traced so far.
  std::uint64_t rays() const { return this->rays_; }

private:
  void orderLights();
  void beginChunk();
  void traceBlock(std::size_t firstLight, std::size_t lastLight);
  std::uint64_t traceTile(std::size_t firstElement, std::size_t lastElement, std::size_t firstLight,
    std::size_t lastLight);
  void explain();
  void explainOne(std::size_t element, SampleStarts& starts) const;
  void finishChunk();
  std::size_t chunkSize() const;
  double shareDone() const;

  const DataScene& scene_;
  const ReceiverStarts& receivers_;
  const EmbreeTracer& tracer_;
  Plan plan_;
  VisibilityArrays arrays_;
  std::vector<std::uint32_t> order_;         ///< the elements that have a surface
  std::vector<std::uint32_t> numberOfLight_; ///< the caller's number of each light in plan_.lights
  std::optional<ShadowRayLight> explained_;
  double allHours_ = 0.0;
  std::size_t bytesOfBits_;
  std::size_t samplesOfElement_;

  /// The present chunk.
  std::size_t chunkBegin_ = 0; ///< in order_
  std::size_t chunkEnd_ = 0;
  bool chunkBegun_ = false;
  std::size_t nextLight_ = 0;
  std::vector<double> hours_; ///< of each sample
  std::uint64_t rays_ = 0;
};

} // namespace gnomon
