#ifndef gnomon_lights_LightSamples_h
#define gnomon_lights_LightSamples_h

#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace gnomon
{

/// Points of an area light: as many as ShadowSettings::lightSamples says, in the order that lightSeed
/// says, the same ones at every call and on every machine.
///
/// They are the first points of Sobol's sequence (1967; direction numbers of Joe and Kuo 2008),
/// Owen-scrambled (Owen 1995, by the hash of Burley 2020), so that of 2^m points each part of the unit
/// square that is 2^-a wide and 2^(a-m) high holds one. Every pixel gets them with a digital
/// shift of its own: bits of the coordinates that are flipped, which keeps that property, and makes the
/// error of neighbours noise instead of bands.
///
/// They are taken to disks by the concentric map (Shirley and Chiu 1997), which keeps areas. A ball's are
/// those of the disk, lifted: (x, y, sqrt(1 - x^2 - y^2) cos(pi w)). This is a uniform point of the
/// sphere in four dimensions less its fourth coordinate, so that the ball looks the same from all sides: an
/// even disk.
class LightSamples
{
public:
  /// A pixel's digital shift.
  struct Shift
  {
    glm::uvec3 bits{ 0u };
    std::uint32_t order = 0; ///< see offset()
  };

  /// @param light with an area
  explicit LightSamples(const ShadowLight& light);

  int count() const { return static_cast<int>(this->points_.size()); }

  /// What shifts the samples of a pixel of the picture.
  Shift shiftOf(std::uint32_t column, std::uint32_t row) const;

  /// Point `i` with a pixel's shift, from the light's centre, as LightArea measures it. Of a power of two of
  /// samples, point i of any pixel lies in the same one of as many equal parts of the light: what pixels side
  /// by side trace together stays together.
  glm::vec3 offset(int i, const Shift& shift) const;

  /// Point `i` without shift, of points that are as even over one half of the light as those of offset() are over
  /// all of it: with the points opposite, they are as even over all of it.
  glm::vec3 offsetInHalf(int i) const;

private:
  glm::vec3 placeOf(const glm::uvec3& point) const;

  std::vector<glm::uvec3> points_; ///< fractions of 2^32
  std::uint32_t seed_;
  int columnBits_ =
    0; ///< the parts of the light, of a power of two of samples: 2^columnBits_ across
  int rowBits_ = 0;
  LightArea::Shape shape_;
  glm::mat3 worldFromUnit_;
};

/// A light's place in centred coordinates: (position, 1), or (unit vector towards it, 0).
glm::dvec4 lightPoint(const ShadowLight& light, const glm::dvec3& centreWorld);

/// LightSamples without shift, each a place as lightPoint() has it, for techniques that see the light from the
/// same points in all pixels; of a light without area the one of lightPoint().
std::vector<glm::dvec4> lightSamples(const ShadowLight& light, const glm::dvec3& centreWorld);

/// As many points as ShadowSettings::lightSamples says for techniques that see the light from the same points in all
/// pixels, and want each one's opposite among them, from the light's centre, as LightArea measures them.
///
/// From the middle outwards, so that what is seen from the first ones is what is seen from a smaller light. Every point is
/// followed by its opposite; an odd number of points begins with the centre. Of a light without area or without extent,
/// the centre alone.
std::vector<glm::dvec3> pairedLightSamples(const ShadowLight& light);

} // namespace gnomon

#endif
