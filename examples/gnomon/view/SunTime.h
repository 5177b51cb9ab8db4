#pragma once

#include "Scene.h"

#include <ctime>
#include <string>

namespace gnomon::tool
{

/// A date, a time with its zone, and a place on earth.
struct SunTime
{
  std::time_t clock = 0; ///< seconds of the date and time in their zone, since 1970 there
  int zoneMinutes = 0;   ///< east of UTC
  double latitude = 0.0;
  double longitude = 0.0;

  /// "2024-06-21T12:00+02:00"
  std::string time() const;
};

/// Parse "2024-06-21T12:00+02:00,48.1,11.6": the time, north latitude and east longitude in
/// degrees.
/// @param source for errors
/// @throws BadInput
SunTime parseSunTime(const std::string& text, const std::string& source);
/// Return the text that parseSunTime() reads.
std::string textOf(const SunTime& sun);

/// Return the sun's place in a scene with y up and north along -z.
struct SunPlace
{
  Vec3 towards; ///< unit vector
  double elevationDegrees = 0.0;
};
SunPlace placeOf(const SunTime& sun);

} // namespace gnomon::tool
