#pragma once

#include "lights/HashedPoints.h"
#include "lights/ShadowLight.h"
#include "lights/SobolPoints.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace gnomon
{

/// Sample points of an area light. ShadowSettings::lightSamples sets their number, lightSampling
/// their distribution, lightSeed their order. They are the same at every call and on every machine.
///
/// The concentric map (Shirley and Chiu 1997), which preserves areas, takes points of the unit
/// square (SobolPoints.h, HashedPoints.h) to disks. A ball's points are the disk's, lifted: (x, y,
/// sqrt(1 - x^2 - y^2) cos(pi w)). This is a uniform point of the 3-sphere without its fourth
/// coordinate. So the ball looks like a uniform disk from all sides.
class LightSamples
{
public:
  /// Destination of several offsets' coordinates, one array per axis.
  struct Coordinates
  {
    float* x;
    float* y;
    float* z;
  };

  /// @param light with an area
  explicit LightSamples(const ShadowLight& light);

  int count() const { return this->count_; }

  /// Return the values that make a pixel's samples differ from other pixels' samples.
  SamplePixel pixel(std::uint32_t column, std::uint32_t row) const;

  /// Return sample `i` of a pixel, as an offset from the light's centre in LightArea's units.
  glm::vec3 offset(int i, const SamplePixel& pixel) const;

  /// Compute the offset of one sample for each of `count` pixels.
  void offsets(const std::uint32_t* samples, const SamplePixel* pixels, std::size_t count,
    const Coordinates& to) const;

  /// Compute the offsets of all samples of a pixel.
  void offsets(const SamplePixel& pixel, const Coordinates& to) const;

  /// Return sample `i` of half the light, for all pixels alike. These samples cover half the light
  /// as evenly as those of offset() cover all of it. Together with their opposite points they cover
  /// all of it.
  glm::vec3 offsetInHalf(int i) const;

private:
  template <typename PointOf>
  void place(std::size_t count, const PointOf& pointOf, const Coordinates& to) const;

  int count_;
  std::variant<SobolPoints, HashedPoints> points_;
  LightArea::Shape shape_;
  glm::mat3 worldFromUnit_;
};

/// Map a point of the square of half side 1 to the unit disk by the concentric map (Shirley and
/// Chiu 1997). It preserves ratios of areas, and distances up to a bounded factor.
glm::vec2 diskPoint(const glm::vec2& square);

/// Return a light's place in centred coordinates: (position, 1), or (unit vector towards the light,
/// 0).
glm::dvec4 lightPoint(const ShadowLight& light, const glm::dvec3& centreWorld);

/// Return the samples that all pixels share, each in the form of lightPoint(). A light without area
/// has one sample, lightPoint().
std::vector<glm::dvec4> lightSamples(const ShadowLight& light, const glm::dvec3& centreWorld);

/// Return ShadowSettings::lightSamples points that all pixels share, each with its opposite point.
/// They are offsets from the light's centre, in LightArea's units.
///
/// Points are sorted from the centre outwards, so the first points sample a smaller light. Each
/// point is followed by its opposite. An odd number of points begins with the centre. A light
/// without area or extent has the centre only.
std::vector<glm::dvec3> pairedLightSamples(const ShadowLight& light);

/// Return how many of `all` paired points a frame should have, if it adds points to those of
/// previous frames. The result holds whole pairs, and the centre if `all` is odd.
/// @param before points of previous frames
/// @param perFrame least number of points that each frame adds; 0: every frame has all points
std::size_t pairedPointsWanted(std::size_t all, std::size_t before, std::size_t perFrame);

/// True if a number of samples is a square, as jittered samples require.
bool isSquare(int samples);

/// Return why the light's number of samples is refused; empty if it is not. Jittered samples fill a
/// square grid.
std::string refusedSamples(const ShadowLight& light);

} // namespace gnomon
