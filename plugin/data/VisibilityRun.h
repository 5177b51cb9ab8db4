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

/// A light, or the sun in one of its places.
struct WeightedLight
{
  ShadowRayLight ray;
  double weight; ///< hours
  /// Two vectors across the way to it that take the unit disc to what it looks like from the scene,
  /// at the distance of `ray.toLight`; 0 of a point.
  glm::vec3 discX{ 0.0f };
  glm::vec3 discY{ 0.0f };
};

/// What became of a shadow ray. The numbers are public (vtkGnomonVisibilityFilter).
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

/// Where results go: an entry for each element. They are filled with what stands for no surface.
/// Null: not wanted.
struct VisibilityArrays
{
  float* hours;
  float* fraction;
  float* error;       ///< standard error of the fraction
  std::uint8_t* bits; ///< bit d % 8 of byte d / 8 of an element: whether it is lit by light d
  std::uint8_t* fate; ///< of the explained light
  vtkIdType* blockerCell;
  int* blockerInput;
};

/// Traces the shadow rays from elements to lights, in parts, so that it can stop between them and
/// go on later. Its results depend neither on the parts nor on threads.
///
/// Elements are visited a chunk after the other, and of a chunk one block of lights after the
/// other: so memory depends on neither. Packets hold the rays of one sample to lights side by side,
/// or, of few lights, those of neighbours.
class VisibilityRun
{
public:
  struct Plan
  {
    std::vector<WeightedLight> lights;
    glm::vec3 up{ 0.0f };      ///< unit; what is not above the ground is dark. 0: no ground
    std::size_t explained = 0; ///< the light whose fates are told
    bool bothSides = false;    ///< elements receive on the side that faces the light
  };

  /// @param scene, starts, tracer, arrays stay where they are
  /// @param tracer has the scene's snapshot
  VisibilityRun(const DataScene& scene, const ReceiverStarts& starts, const EmbreeTracer& tracer,
    Plan plan, const VisibilityArrays& arrays);

  /// Goes on until all is done, or told to stop.
  /// @param goOn told the share that is done, after each part; false: stop
  /// @return whether all is done
  bool go(const std::function<bool(double)>& goOn);

  /// Rays traced so far.
  std::uint64_t rays() const { return this->rays_; }

private:
  class Tile;
  void orderLights();
  void beginChunk();
  void traceBlock(std::size_t firstLight, std::size_t lastLight);
  std::uint64_t traceTile(std::size_t firstElement, std::size_t lastElement, std::size_t firstLight,
    std::size_t lastLight);
  void explain();
  void explainOne(std::size_t element, RayStarts& starts) const;
  void finishChunk();
  std::size_t chunkSize() const;
  double shareDone() const;

  const DataScene& scene_;
  const ReceiverStarts& receivers_;
  const EmbreeTracer& tracer_;
  Plan plan_;
  VisibilityArrays arrays_;
  std::vector<std::uint32_t> order_;         ///< the elements that have a surface
  std::vector<std::uint32_t> numberOfLight_; ///< by place in plan_.lights: the order of the caller
  std::optional<ShadowRayLight> explained_;
  double allHours_ = 0.0;
  std::size_t bytesOfBits_;
  std::size_t samplesOfElement_;

  /// The chunk in hand.
  std::size_t chunkBegin_ = 0; ///< in order_
  std::size_t chunkEnd_ = 0;
  bool chunkBegun_ = false;
  std::size_t nextLight_ = 0;
  std::vector<double> hours_; ///< of each sample
  std::uint64_t rays_ = 0;
};

} // namespace gnomon
