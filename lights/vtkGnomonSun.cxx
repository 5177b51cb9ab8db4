#include "vtkGnomonSun.h"

#include "lights/NumberSetters.h"
#include "lights/SunPosition.h"

#include "vtkDoubleArray.h"
#include "vtkObjectFactory.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

vtkStandardNewMacro(vtkGnomonSun);

namespace
{

constexpr double minutesOfDay = 1440.0;

bool areFinite(std::initializer_list<double> numbers)
{
  return std::all_of(
    numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

bool isWithin(double number, double low, double high)
{
  return number >= low && number <= high; // false for NaN
}

/// The sun's place in degrees, with refraction if that is on.
struct Seen
{
  double azimuth;
  double elevation;
  double declination;
};

Seen see(const vtkGnomonSun* sun, double julianDay)
{
  auto* of = const_cast<vtkGnomonSun*>(sun); // VTK's getters are not const
  const gnomon::SunPosition position = gnomon::sunPosition(
    { julianDay, of->GetDeltaT(), of->GetLatitude(), of->GetLongitude(), of->GetAltitude() });
  const double lift = of->GetRefraction()
    ? gnomon::refractionDegrees(position.elevationDegrees, of->GetPressure(), of->GetTemperature())
    : 0.0;
  return { position.azimuthDegrees, position.elevationDegrees + lift, position.declinationDegrees };
}

glm::dvec3 vectorOf(const double vector[3])
{
  return { vector[0], vector[1], vector[2] };
}

/// Return the part of `north` along the ground, without length if `north` is along `up`.
glm::dvec3 levelNorth(const glm::dvec3& north, const glm::dvec3& up)
{
  return north - glm::dot(north, up) * up;
}

/// Return the direction towards the sun. SetNorthAndUp() ensures that North and Up have a length
/// and are not parallel.
glm::dvec3 directionOf(const Seen& seen, const double north[3], const double up[3])
{
  const glm::dvec3 above = glm::normalize(vectorOf(up));
  const glm::dvec3 ahead = glm::normalize(levelNorth(glm::normalize(vectorOf(north)), above));
  const glm::dvec3 east = glm::cross(ahead, above);
  const double azimuth = glm::radians(seen.azimuth);
  const double elevation = glm::radians(seen.elevation);
  return glm::normalize(
    std::cos(elevation) * (std::cos(azimuth) * ahead + std::sin(azimuth) * east) +
    std::sin(elevation) * above);
}

} // namespace

/// The arrays to fill with suns, and the steps of a day.
struct vtkGnomonSun::Path
{
  int stepsOfDay;
  double stepMinutes;
  vtkDoubleArray* directions;
  vtkDoubleArray* hours;
  vtkDoubleArray* times;

  Path(double step, vtkDoubleArray* toDirections, vtkDoubleArray* toHours, vtkDoubleArray* toTimes)
    : stepsOfDay(static_cast<int>(std::ceil(minutesOfDay / step - 1e-9)))
    , stepMinutes(step)
    , directions(toDirections)
    , hours(toHours)
    , times(toTimes)
  {
    this->directions->Initialize();
    this->directions->SetNumberOfComponents(3);
    for (vtkDoubleArray* numbers : { this->hours, this->times })
    {
      if (numbers)
      {
        numbers->Initialize();
        numbers->SetNumberOfComponents(1);
      }
    }
  }
};

//------------------------------------------------------------------------------
void vtkGnomonSun::SetDate(int year, int month, int day)
{
  if (year < 1583 || year > 6000 || month < 1 || month > 12 || day < 1 ||
    day > gnomon::daysOfMonth(year, month))
  {
    vtkErrorMacro("There is no date " << std::to_string(year) << "-" << month << "-" << day
                                      << ": dates go from 1583-01-01 to 6000-12-31.");
    return;
  }
  if (this->Year != year || this->Month != month || this->Day != day)
  {
    this->Year = year;
    this->Month = month;
    this->Day = day;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonSun::SetTime(int hour, int minute, double second, double zoneHours)
{
  if (hour < 0 || hour > 24 || minute < 0 || minute > 59 || !(second >= 0.0 && second < 60.0) ||
    !isWithin(zoneHours, -14.0, 14.0))
  {
    vtkErrorMacro("There is no time " << hour << ":" << minute << ":" << second << " in a zone "
                                      << zoneHours
                                      << " hours east of UTC: hours are in [0, 24], minutes and "
                                         "seconds in [0, 60), zones in [-14, 14].");
    return;
  }
  if (this->Hour != hour || this->Minute != minute || this->Second != second ||
    this->ZoneHours != zoneHours)
  {
    this->Hour = hour;
    this->Minute = minute;
    this->Second = second;
    this->ZoneHours = zoneHours;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonSun::SetPlace(double latitude, double longitude)
{
  if (!isWithin(latitude, -90.0, 90.0) || !isWithin(longitude, -180.0, 360.0))
  {
    vtkErrorMacro("There is no place at latitude "
      << latitude << " and longitude " << longitude
      << ": they are in [-90, 90] and [-180, 360] degrees.");
    return;
  }
  if (this->Latitude != latitude || this->Longitude != longitude)
  {
    this->Latitude = latitude;
    this->Longitude = longitude;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonSun::SetAltitude(double metres)
{
  gnomon::setWithin(this, "Altitude", metres, -1000.0, 100000.0, this->Altitude);
}

//------------------------------------------------------------------------------
void vtkGnomonSun::SetDeltaT(double seconds)
{
  gnomon::setWithin(this, "DeltaT", seconds, -100000.0, 100000.0, this->DeltaT);
}

//------------------------------------------------------------------------------
void vtkGnomonSun::SetAir(double pressureMillibar, double celsius)
{
  if (!isWithin(pressureMillibar, 0.0, 5000.0) || !isWithin(celsius, -200.0, 1000.0))
  {
    vtkErrorMacro("There is no air of " << pressureMillibar << " millibar and " << celsius
                                        << " degrees Celsius: they are in [0, 5000] and "
                                           "[-200, 1000].");
    return;
  }
  if (this->Pressure != pressureMillibar || this->Temperature != celsius)
  {
    this->Pressure = pressureMillibar;
    this->Temperature = celsius;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonSun::SetNorthAndUp(const double north[3], const double up[3])
{
  const double northLength = glm::length(vectorOf(north));
  const double upLength = glm::length(vectorOf(up));
  const bool haveLength =
    areFinite({ northLength, upLength }) && northLength > 0.0 && upLength > 0.0;
  // Below a millionth of a right angle, rounding would rotate the level north direction.
  if (!haveLength ||
    !(glm::length(levelNorth(vectorOf(north) / northLength, vectorOf(up) / upLength)) > 1e-6))
  {
    vtkErrorMacro("North (" << north[0] << ", " << north[1] << ", " << north[2] << ") and up ("
                            << up[0] << ", " << up[1] << ", " << up[2]
                            << ") must be finite, have a length, and not be parallel.");
    return;
  }
  if (!std::equal(north, north + 3, this->North) || !std::equal(up, up + 3, this->Up))
  {
    std::copy_n(north, 3, this->North);
    std::copy_n(up, 3, this->Up);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
/// Return the Julian day, in UTC, at which the date begins in the zone.
double vtkGnomonSun::Midnight() const
{
  return gnomon::julianDayOf(this->Year, this->Month, this->Day) - this->ZoneHours / 24.0;
}

//------------------------------------------------------------------------------
double vtkGnomonSun::Now() const
{
  return this->Midnight() + (this->Hour + (this->Minute + this->Second / 60.0) / 60.0) / 24.0;
}

//------------------------------------------------------------------------------
double vtkGnomonSun::GetAzimuth()
{
  return see(this, this->Now()).azimuth;
}

//------------------------------------------------------------------------------
double vtkGnomonSun::GetElevation()
{
  return see(this, this->Now()).elevation;
}

//------------------------------------------------------------------------------
double vtkGnomonSun::GetDeclination()
{
  return see(this, this->Now()).declination;
}

//------------------------------------------------------------------------------
void vtkGnomonSun::GetDirection(double direction[3])
{
  const glm::dvec3 towards = directionOf(see(this, this->Now()), this->North, this->Up);
  for (int axis = 0; axis < 3; ++axis)
  {
    direction[axis] = towards[axis];
  }
}

//------------------------------------------------------------------------------
/// True if a path can be computed. Else report an error.
bool vtkGnomonSun::IsStep(double stepMinutes, vtkDoubleArray* directions)
{
  if (!directions)
  {
    vtkErrorMacro("A path needs an array for its directions.");
    return false;
  }
  if (!(stepMinutes > 0.0 && stepMinutes <= minutesOfDay))
  {
    vtkErrorMacro("stepMinutes was to be " << stepMinutes << ", expected a number in (0, 1440].");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
/// Append a day's suns to a path.
/// @param julianDay the day's midnight in the zone, in UTC
/// @param days number of days that each sun represents
/// @param hoursBefore hours from the path's first midnight to this day's
void vtkGnomonSun::AddDay(Path& path, double julianDay, double days, double hoursBefore) const
{
  for (int step = 0; step < path.stepsOfDay; ++step)
  {
    const double begin = step * path.stepMinutes;
    const double end = std::min(begin + path.stepMinutes, minutesOfDay);
    const double middle = 0.5 * (begin + end);
    const Seen seen = see(this, julianDay + middle / minutesOfDay);
    if (!(seen.elevation > 0.0))
    {
      continue;
    }
    const glm::dvec3 towards = directionOf(seen, this->North, this->Up);
    path.directions->InsertNextTuple3(towards.x, towards.y, towards.z);
    if (path.hours)
    {
      path.hours->InsertNextValue(days * (end - begin) / 60.0);
    }
    if (path.times)
    {
      path.times->InsertNextValue(hoursBefore + middle / 60.0);
    }
  }
}

//------------------------------------------------------------------------------
bool vtkGnomonSun::MakeDayPath(
  double stepMinutes, vtkDoubleArray* directions, vtkDoubleArray* hours, vtkDoubleArray* times)
{
  if (!this->IsStep(stepMinutes, directions))
  {
    return false;
  }
  Path path(stepMinutes, directions, hours, times);
  this->AddDay(path, this->Midnight(), 1.0, 0.0);
  return true;
}

//------------------------------------------------------------------------------
bool vtkGnomonSun::MakeYearPath(int dayStep, double stepMinutes, vtkDoubleArray* directions,
  vtkDoubleArray* hours, vtkDoubleArray* times)
{
  if (!this->IsStep(stepMinutes, directions))
  {
    return false;
  }
  if (dayStep < 1 || dayStep > 366)
  {
    vtkErrorMacro("dayStep was to be " << dayStep << ", expected an integer in [1, 366].");
    return false;
  }
  Path path(stepMinutes, directions, hours, times);
  const double first = gnomon::julianDayOf(this->Year, 1, 1);
  const int daysOfYear = static_cast<int>(gnomon::julianDayOf(this->Year + 1, 1, 1) - first);
  for (int day = 0; day < daysOfYear; day += dayStep)
  {
    const int shared = std::min(dayStep, daysOfYear - day);
    const int middle = day + shared / 2;
    this->AddDay(path, first + middle - this->ZoneHours / 24.0, shared, 24.0 * middle);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkGnomonSun::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Date: " << this->Year << "-" << this->Month << "-" << this->Day << "\n";
  os << indent << "Time: " << this->Hour << ":" << this->Minute << ":" << this->Second << "\n";
  os << indent << "ZoneHours: " << this->ZoneHours << "\n";
  os << indent << "Latitude: " << this->Latitude << "\n";
  os << indent << "Longitude: " << this->Longitude << "\n";
  os << indent << "Altitude: " << this->Altitude << "\n";
  os << indent << "DeltaT: " << this->DeltaT << "\n";
  os << indent << "Refraction: " << (this->Refraction ? "On" : "Off") << "\n";
  os << indent << "Pressure: " << this->Pressure << "\n";
  os << indent << "Temperature: " << this->Temperature << "\n";
  os << indent << "North: " << this->North[0] << ", " << this->North[1] << ", " << this->North[2]
     << "\n";
  os << indent << "Up: " << this->Up[0] << ", " << this->Up[1] << ", " << this->Up[2] << "\n";
}
