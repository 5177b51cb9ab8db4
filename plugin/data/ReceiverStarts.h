#pragma once

#include "lights/SobolPoints.h"
#include "plugin/data/DataScene.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Which side of a surface receives light.
enum class ReceivingSide
{
  Front, ///< the side that shows the corners counter-clockwise
  Back,
  Both ///< for each light the side that faces it
};

/// Where the shadow rays of some elements start: one array for each number.
struct RayStarts
{
  std::vector<glm::vec3> position; ///< on the triangle, centred
  std::vector<glm::vec3> normal;   ///< of the triangle, unit, on the receiving side
  std::vector<float> offset;       ///< ShadowRay.h

  /// Samples: those of an element lie side by side. A sample is lit in a direction if a ray from
  /// one of its starts, first[s] up to first[s + 1], is free. A cell's has one start, and a point's
  /// one for each plane that meets there.
  std::vector<std::uint32_t> first;
  /// Where the samples look on the light's disc, in radii; empty where they all look at its middle.
  std::vector<glm::vec2> disc;

  std::size_t samples() const { return this->first.size() - 1; }
  void clear();
};

/// Finds where the shadow rays of cells and points start.
///
/// A cell has one start in its centroid, or several spread evenly over its triangles by area
/// (SobolPoints), each cell's by itself. A point starts a thousandth of the way towards the middles
/// of its triangles. So it sees what a picture shows beside it, and not the edge on which it lies.
class ReceiverStarts
{
public:
  /// @param ofPoints whether elements are points of the receivers; else cells
  /// @param samples of each element; one is its middle
  /// @param hasDisc whether samples look at different points of the light's disc
  /// @param scene stays where it is
  ReceiverStarts(
    const DataScene& scene, bool ofPoints, int samples, bool hasDisc, ReceivingSide side);

  std::size_t count() const { return this->elements_.count(); }
  int samples() const { return this->samples_; }
  /// Whether an element has a surface that light could fall on.
  bool hasSurface(std::size_t element) const
  {
    return this->elements_.first[element] < this->elements_.first[element + 1];
  }

  /// Elements in an order in which neighbours follow each other: those with a surface alone, along
  /// a Z curve.
  std::vector<std::uint32_t> order() const;

  /// Appends an element's samples.
  /// @param middle one sample in the middle, looking at the light's middle, in place of its samples
  void append(std::size_t element, RayStarts& starts, bool middle = false) const;

private:
  void appendStart(
    std::uint32_t triangle, const glm::dvec3& at, float leastOffset, RayStarts& starts) const;
  void appendMiddle(std::size_t element, RayStarts& starts) const;
  void appendSpread(std::size_t element, RayStarts& starts) const;
  void appendCorners(std::size_t element, RayStarts& starts) const;
  void appendDisc(std::size_t element, RayStarts& starts) const;
  glm::dvec3 middleOf(std::size_t element) const;
  float offsetOf(std::uint32_t triangle) const;

  const DataScene& scene_;
  DataScene::Elements elements_;
  bool ofPoints_;
  int samples_;
  bool hasDisc_;
  ReceivingSide side_;
  SobolPoints points_;
  SobolPoints discPoints_;
};

} // namespace gnomon
