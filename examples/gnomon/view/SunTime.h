#pragma once

#include "Errors.h"
#include "Scene.h"
#include "Text.h"

#include "lights/vtkGnomonSun.h"

#include <vtkNew.h>

#include <cstdio>
#include <cstdlib>
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
  std::string time() const
  {
    char text[64];
    char* const zone = text + std::strftime(text, 32, "%Y-%m-%dT%H:%M", std::gmtime(&this->clock));
    const int minutes = std::abs(this->zoneMinutes);
    std::snprintf(
      zone, 32, "%c%02d:%02d", this->zoneMinutes < 0 ? '-' : '+', minutes / 60, minutes % 60);
    return text;
  }
};

/// Parse "2024-06-21T12:00+02:00,48.1,11.6": the time, north latitude and east longitude in
/// degrees.
/// @param source for errors
/// @throws BadInput
inline SunTime parseSunTime(const std::string& text, const std::string& source)
{
  SunTime sun;
  const std::vector<std::string> parts = split(text, ',');
  std::tm date{};
  int zoneHours = 0;
  int zoneMinutes = 0;
  char sign = 0;
  int read = 0;
  const bool timed =
    std::sscanf(parts[0].c_str(), "%4d-%2d-%2dT%2d:%2d%c%2d:%2d%n", &date.tm_year, &date.tm_mon,
      &date.tm_mday, &date.tm_hour, &date.tm_min, &sign, &zoneHours, &zoneMinutes, &read) == 8 &&
    read == static_cast<int>(parts[0].size());
  const auto latitude = parseWord<double>(parts, 1);
  const auto longitude = parseWord<double>(parts, 2);
  const auto within = [](auto low, auto value, auto high) { return low <= value && value <= high; };
  const int year = date.tm_year;
  date.tm_year -= 1900;
  date.tm_mon -= 1;
  std::tm valid = date; // a day that its month lacks becomes another one
  sun.clock = timegm(&valid);
  if (!timed || parts.size() != 3 || !latitude || !longitude || !within(1600, year, 5999) ||
    valid.tm_mon != date.tm_mon || valid.tm_mday != date.tm_mday || valid.tm_hour != date.tm_hour ||
    valid.tm_min != date.tm_min || (sign != '+' && sign != '-') || !within(0, zoneHours, 13) ||
    !within(0, zoneMinutes, 59) || !within(-90.0, *latitude, 90.0) ||
    !within(-180.0, *longitude, 360.0))
  {
    throw BadInput(source + ": found " + quoted(text) +
      ", expected a date, a time with its zone, north latitude and east longitude, for example "
      "2024-06-21T12:00+02:00,48.1,11.6");
  }
  sun.zoneMinutes = (sign == '-' ? -1 : 1) * (60 * zoneHours + zoneMinutes);
  sun.latitude = *latitude;
  sun.longitude = *longitude;
  return sun;
}

inline std::string textOf(const SunTime& sun)
{
  char place[64];
  std::snprintf(place, sizeof place, ",%.17g,%.17g", sun.latitude, sun.longitude);
  return sun.time() + place;
}

/// Return the sun's place in a scene with y up and north along -z.
struct SunPlace
{
  Vec3 towards; ///< unit vector
  double elevationDegrees = 0.0;
};
inline SunPlace placeOf(const SunTime& sun)
{
  constexpr double north[3] = { 0.0, 0.0, -1.0 };
  constexpr double up[3] = { 0.0, 1.0, 0.0 };
  vtkNew<vtkGnomonSun> algorithm;
  const std::tm date = *std::gmtime(&sun.clock);
  algorithm->SetDate(date.tm_year + 1900, date.tm_mon + 1, date.tm_mday);
  algorithm->SetTime(date.tm_hour, date.tm_min, 0.0, sun.zoneMinutes / 60.0);
  algorithm->SetPlace(sun.latitude, sun.longitude);
  algorithm->SetNorthAndUp(north, up);
  SunPlace place;
  algorithm->GetDirection(place.towards.data());
  place.elevationDegrees = algorithm->GetElevation();
  return place;
}

} // namespace gnomon::tool
