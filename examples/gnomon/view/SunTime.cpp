#include "view/SunTime.h"

#include "Errors.h"
#include "Text.h"

#include "lights/vtkGnomonSun.h"

#include <vtkNew.h>

#include <cstdio>
#include <cstdlib>

namespace gnomon::tool
{
namespace
{

constexpr int minutesOfDay = 24 * 60;

int daysOf(int month, int year)
{
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return month == 2                                         ? (leap ? 29 : 28)
    : month == 4 || month == 6 || month == 9 || month == 11 ? 30
                                                            : 31;
}

} // namespace

//------------------------------------------------------------------------------
void SunTime::addMinutes(int count)
{
  this->minutes += count;
  for (; this->minutes < 0; this->minutes += minutesOfDay)
  {
    if (--this->day == 0)
    {
      this->year -= this->month == 1;
      this->month = this->month == 1 ? 12 : this->month - 1;
      this->day = daysOf(this->month, this->year);
    }
  }
  for (; this->minutes >= minutesOfDay; this->minutes -= minutesOfDay)
  {
    if (++this->day > daysOf(this->month, this->year))
    {
      this->day = 1;
      this->year += this->month == 12;
      this->month = this->month == 12 ? 1 : this->month + 1;
    }
  }
}

//------------------------------------------------------------------------------
std::string SunTime::time() const
{
  const int zone = std::abs(this->zoneMinutes);
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d%c%02d:%02d", this->year, this->month,
    this->day, this->minutes / 60, this->minutes % 60, this->zoneMinutes < 0 ? '-' : '+', zone / 60,
    zone % 60);
  return text;
}

//------------------------------------------------------------------------------
SunTime parseSunTime(const std::string& text, const std::string& source)
{
  SunTime sun;
  const std::vector<std::string> parts = split(text, ',');
  int hour = 0;
  int minute = 0;
  int zoneHours = 0;
  int zoneMinutes = 0;
  char sign = 0;
  int read = 0;
  const bool timed =
    std::sscanf(parts[0].c_str(), "%4d-%2d-%2dT%2d:%2d%c%2d:%2d%n", &sun.year, &sun.month, &sun.day,
      &hour, &minute, &sign, &zoneHours, &zoneMinutes, &read) == 8 &&
    read == static_cast<int>(parts[0].size());
  const auto latitude = parseWord<double>(parts, 1);
  const auto longitude = parseWord<double>(parts, 2);
  const auto within = [](auto low, auto value, auto high) { return low <= value && value <= high; };
  if (!timed || parts.size() != 3 || !latitude || !longitude || !within(1600, sun.year, 5999) ||
    !within(1, sun.month, 12) || !within(1, sun.day, daysOf(sun.month, sun.year)) ||
    !within(0, hour, 23) || !within(0, minute, 59) || (sign != '+' && sign != '-') ||
    !within(0, zoneHours, 13) || !within(0, zoneMinutes, 59) || !within(-90.0, *latitude, 90.0) ||
    !within(-180.0, *longitude, 360.0))
  {
    throw BadInput(source + ": found " + quoted(text) +
      ", expected a date, a time with its zone, north latitude and east longitude, for example "
      "2024-06-21T12:00+02:00,48.1,11.6");
  }
  sun.minutes = 60 * hour + minute;
  sun.zoneMinutes = (sign == '-' ? -1 : 1) * (60 * zoneHours + zoneMinutes);
  sun.latitude = *latitude;
  sun.longitude = *longitude;
  return sun;
}

//------------------------------------------------------------------------------
std::string textOf(const SunTime& sun)
{
  char place[64];
  std::snprintf(place, sizeof place, ",%.17g,%.17g", sun.latitude, sun.longitude);
  return sun.time() + place;
}

//------------------------------------------------------------------------------
SunPlace placeOf(const SunTime& sun)
{
  constexpr double north[3] = { 0.0, 0.0, -1.0 };
  constexpr double up[3] = { 0.0, 1.0, 0.0 };
  vtkNew<vtkGnomonSun> algorithm;
  algorithm->SetDate(sun.year, sun.month, sun.day);
  algorithm->SetTime(sun.minutes / 60, sun.minutes % 60, 0.0, sun.zoneMinutes / 60.0);
  algorithm->SetPlace(sun.latitude, sun.longitude);
  algorithm->SetNorthAndUp(north, up);
  SunPlace place;
  algorithm->GetDirection(place.towards.data());
  place.elevationDegrees = algorithm->GetElevation();
  return place;
}

} // namespace gnomon::tool
