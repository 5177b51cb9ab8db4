#pragma once

#include "lights/HashedPoints.h"
#include "lights/ShadowLight.h"
#include "lights/SobolPoints.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace gnomon
{

/// Points of an area light: as many as ShadowSettings::lightSamples says, as lightSampling says, in
/// the order that lightSeed says, the same ones at every call and on every machine.
///
/// Points of the unit square (SobolPoints.h, HashedPoints.h) are taken to disks by the concentric
/// map (Shirley and Chiu 1997), which keeps areas. A ball's are those of the disk, lifted: (x, y,
/// sqrt(1 - x^2 - y^2) cos(pi w)). This is a uniform point of the sphere in four dimensions less
/// its fourth coordinate, so that the ball looks the same from all sides: an even disk.
class LightSamples
{
public:
  /// Where the coordinates of several offsets are put, those of the same axis side by side.
  struct Coordinates
  {
    float* x;
    float* y;
    float* z;
  };

  /// @param light with an area
  explicit LightSamples(const ShadowLight& light);

  int count() const { return this->count_; }

  /// What is special about the samples of a pixel of the picture.
  SamplePixel pixel(std::uint32_t column, std::uint32_t row) const;

  /// Sample `i` of a pixel, from the light's centre, as LightArea measures it.
  glm::vec3 offset(int i, const SamplePixel& pixel) const;

  /// The same of one sample for each of `count` pixels.
  void offsets(const std::uint32_t* samples, const SamplePixel* pixels, std::size_t count,
    const Coordinates& to) const;

  /// The same of all samples of a pixel.
  void offsets(const SamplePixel& pixel, const Coordinates& to) const;

  /// Point `i` without shift, of points that are as even over one half of the light as those of
  /// offset() are over all of it: with the points opposite, they are as even over all of it.
  glm::vec3 offsetInHalf(int i) const;

private:
  template <typename PointOf>
  void place(std::size_t count, const PointOf& pointOf, const Coordinates& to) const;

  int count_;
  std::variant<SobolPoints, HashedPoints> points_;
  LightArea::Shape shape_;
  glm::mat3 worldFromUnit_;
};

/// The concentric map (Shirley and Chiu 1997) from the square of half side 1 to the unit disk,
/// which keeps areas and, but for a factor, distances.
glm::vec2 diskPoint(const glm::vec2& square);

/// A light's place in centred coordinates: (position, 1), or (unit vector towards it, 0).
glm::dvec4 lightPoint(const ShadowLight& light, const glm::dvec3& centreWorld);

/// LightSamples of no pixel, each a place as lightPoint() has it, for techniques that see the light
/// from the same points in all pixels; of a light without area the one of lightPoint().
std::vector<glm::dvec4> lightSamples(const ShadowLight& light, const glm::dvec3& centreWorld);

/// As many points as ShadowSettings::lightSamples says for techniques that see the light from the
/// same points in all pixels, and want each one's opposite among them, from the light's centre, as
/// LightArea measures them.
///
/// From the middle outwards, so that what is seen from the first ones is what is seen from a
/// smaller light. Every point is followed by its opposite; an odd number of points begins with the
/// centre. Of a light without area or without extent, the centre alone.
std::vector<glm::dvec3> pairedLightSamples(const ShadowLight& light);

/// How many of `all` paired points a frame is to have that adds some to those of the frames before:
/// whole pairs, and the centre of an odd number.
/// @param perFrame points that each frame adds at least; 0: all are in every frame
std::size_t pairedPointsWanted(std::size_t all, std::size_t before, std::size_t perFrame);

} // namespace gnomon
