#pragma once

#include "lights/SobolPoints.h"
#include "plugin/data/DataScene.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Return the pixel of an element, for points of SobolPoints that differ between elements.
inline SamplePixel pixelOf(const SobolPoints& points, std::size_t element)
{
  constexpr std::size_t columns = 65536;
  return points.pixel(
    static_cast<std::uint32_t>(element % columns), static_cast<std::uint32_t>(element / columns));
}

/// The side of a surface that receives light.
enum class ReceivingSide
{
  Front, ///< the side that shows the corners counter-clockwise
  Back,
  Both ///< for each light, the side that faces it
};

/// Starts of the shadow rays of some elements, as one array for each quantity.
struct SampleStarts
{
  std::vector<glm::vec3> position; ///< on the triangle, centred
  std::vector<glm::vec3> normal;   ///< of the triangle, unit, on the receiving side
  std::vector<float> offset;       ///< ShadowRay.h

  /// First start of each sample. Samples of an element are adjacent. A sample is lit from a
  /// direction if a ray from one of its starts, first[s] up to first[s + 1], is free. A cell's
  /// sample has one start. A point's sample has one for each plane that meets there.
  std::vector<std::uint32_t> first;
  /// Points of the light's disc that samples see, in radii; empty if all see its middle.
  std::vector<glm::vec2> disc;

  std::size_t samples() const { return this->first.size() - 1; }
  void clear();
};

/// Finds the starts of shadow rays from cells and points.
///
/// A cell has one start in its centroid, or several spread evenly over its triangles by area
/// (SobolPoints), independently of other cells. A point starts a thousandth of the way towards the
/// middles of its triangles. So it sees what a picture shows beside it, not the edge on which it
/// lies.
class ReceiverStarts
{
public:
  /// @param ofPoints true if elements are points of the receivers; else they are cells
  /// @param samples per element; a single one is its middle
  /// @param hasDisc true if samples see different points of the light's disc
  /// @param scene must outlive this
  ReceiverStarts(
    const DataScene& scene, bool ofPoints, int samples, bool hasDisc, ReceivingSide side);

  std::size_t count() const { return this->elements_.count(); }
  int samples() const { return this->samples_; }
  /// True if an element has a surface on which light could fall.
  bool hasSurface(std::size_t element) const
  {
    return this->elements_.first[element] < this->elements_.first[element + 1];
  }

  /// Return the elements with a surface along a Z curve, so that neighbours follow each other.
  std::vector<std::uint32_t> order() const;

  /// Append an element's samples.
  /// @param middle append only one sample, in the middle and seeing the light's middle
  void append(std::size_t element, SampleStarts& starts, bool middle = false) const;

private:
  void appendStart(
    std::uint32_t triangle, const glm::dvec3& at, float leastOffset, SampleStarts& starts) const;
  void appendMiddle(std::size_t element, SampleStarts& starts) const;
  void appendSpread(std::size_t element, SampleStarts& starts) const;
  void appendCorners(std::size_t element, SampleStarts& starts) const;
  void appendDisc(std::size_t element, SampleStarts& starts) const;
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
