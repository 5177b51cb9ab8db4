#include "lights/SunPosition.h"

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace gnomon
{
namespace
{

/// A term A cos(B + C t) of the report's table A4.2, with t in Julian millennia. The source of the
/// table is VSOP87 (Bretagnon and Francou 1988).
struct Term
{
  double a;
  double b;
  double c;
};

constexpr std::array<Term, 25> longitude0{ { { 175347046, 0, 0 },
  { 3341656, 4.6692568, 6283.07585 }, { 34894, 4.6261, 12566.1517 }, { 3497, 2.7441, 5753.3849 },
  { 3418, 2.8289, 3.5231 }, { 3136, 3.6277, 77713.7715 }, { 2676, 4.4181, 7860.4194 },
  { 2343, 6.1352, 3930.2097 }, { 1324, 0.7425, 11506.7698 }, { 1273, 2.0371, 529.691 },
  { 1199, 1.1096, 1577.3435 }, { 990, 5.233, 5884.927 }, { 902, 2.045, 26.298 },
  { 857, 3.508, 398.149 }, { 780, 1.179, 5223.694 }, { 753, 2.533, 5507.553 },
  { 505, 4.583, 18849.228 }, { 492, 4.205, 775.523 }, { 357, 2.92, 0.067 },
  { 317, 5.849, 11790.629 }, { 284, 1.899, 796.298 }, { 271, 0.315, 10977.079 },
  { 243, 0.345, 5486.778 }, { 206, 4.806, 2544.314 }, { 205, 1.869, 5573.143 } } };
constexpr std::array<Term, 4> longitude1{ { { 628331966747, 0, 0 },
  { 206059, 2.678235, 6283.07585 }, { 4303, 2.6351, 12566.1517 }, { 425, 1.59, 3.523 } } };
constexpr std::array<Term, 3> longitude2{ { { 52919, 0, 0 }, { 8720, 1.0721, 6283.0758 },
  { 309, 0.867, 12566.152 } } };
constexpr std::array<Term, 1> longitude3{ { { 289, 5.844, 6283.076 } } };
constexpr std::array<Term, 1> latitude0{ { { 280, 3.199, 84334.662 } } };
/// Only parallax and aberration depend on the distance, and only slightly.
constexpr std::array<Term, 3> distance0{ { { 100013989, 0, 0 }, { 1670700, 3.0984635, 6283.07585 },
  { 13956, 3.05525, 12566.1517 } } };
constexpr std::array<Term, 1> distance1{ { { 103019, 1.10749, 6283.07585 } } };

template <std::size_t count>
double sumOf(const std::array<Term, count>& terms, double t)
{
  double sum = 0.0;
  for (const Term& term : terms)
  {
    sum += term.a * std::cos(term.b + term.c * t);
  }
  return 1e-8 * sum;
}

/// A term of the nutation (table A4.3). Its angle has multiples of the moon's elongation, the sun's
/// and the moon's anomaly, and the moon's latitude and node. Its coefficients are of the sine in
/// longitude and the cosine in obliquity, in 0.0001 arc seconds, and their change per century.
struct NutationTerm
{
  std::array<double, 5> multiples;
  double longitude;
  double longitudePerCentury;
  double obliquity;
  double obliquityPerCentury;
};
constexpr std::array<NutationTerm, 7> nutationTerms{ {
  { { 0, 0, 0, 0, 1 }, -171996, -174.2, 92025, 8.9 },
  { { -2, 0, 0, 2, 2 }, -13187, -1.6, 5736, -3.1 },
  { { 0, 0, 0, 2, 2 }, -2274, -0.2, 977, -0.5 },
  { { 0, 0, 0, 0, 2 }, 2062, 0.2, -895, 0.5 },
  { { 0, 1, 0, 0, 0 }, 1426, -3.4, 54, -0.1 },
  { { 0, 0, 1, 0, 0 }, 712, 0.1, -7, 0.0 },
  { { -2, 1, 0, 2, 2 }, -517, 1.2, 224, -0.6 },
} };

struct Nutation
{
  double longitudeDegrees = 0.0;
  double obliquityDegrees = 0.0;
};

/// @param t Julian centuries of terrestrial time since 2000
Nutation nutationAt(double t)
{
  const std::array<double, 5> arguments = {
    297.85036 + t * (445267.11148 + t * (-0.0019142 + t / 189474.0)),
    357.52772 + t * (35999.05034 + t * (-0.0001603 - t / 300000.0)),
    134.96298 + t * (477198.867398 + t * (0.0086972 + t / 56250.0)),
    93.27191 + t * (483202.017538 + t * (-0.0036825 + t / 327270.0)),
    125.04452 + t * (-1934.136261 + t * (0.0020708 + t / 450000.0)),
  };
  constexpr double degreesOfUnit = 1e-4 / 3600.0;
  Nutation nutation;
  for (const NutationTerm& term : nutationTerms)
  {
    double angle = 0.0;
    for (std::size_t i = 0; i < arguments.size(); ++i)
    {
      angle += term.multiples[i] * arguments[i];
    }
    angle = glm::radians(angle);
    nutation.longitudeDegrees +=
      degreesOfUnit * (term.longitude + term.longitudePerCentury * t) * std::sin(angle);
    nutation.obliquityDegrees +=
      degreesOfUnit * (term.obliquity + term.obliquityPerCentury * t) * std::cos(angle);
  }
  return nutation;
}

/// Return the mean obliquity in degrees (equation 24).
/// @param u time since 2000 in units of 10,000 Julian years
double meanObliquity(double u)
{
  constexpr std::array<double, 11> arcSeconds = { 2.45, 5.79, 27.87, 7.12, -39.05, -249.67, -51.38,
    1999.25, -1.55, -4680.93, 84381.448 };
  double sum = 0.0;
  for (const double coefficient : arcSeconds)
  {
    sum = sum * u + coefficient;
  }
  return sum / 3600.0;
}

double turned(double degrees)
{
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0.0 ? rest + 360.0 : rest;
}

constexpr double julianDay2000 = 2451545.0;
constexpr double daysOfCentury = 36525.0;

} // namespace

SunPosition sunPosition(const SunView& view)
{
  const double century = (view.julianDay - julianDay2000) / daysOfCentury;
  const double centuryTerrestrial =
    (view.julianDay + view.deltaT / 86400.0 - julianDay2000) / daysOfCentury;
  const double t = centuryTerrestrial / 10.0;

  const double heliocentric = sumOf(longitude0, t) +
    t * (sumOf(longitude1, t) + t * (sumOf(longitude2, t) + t * sumOf(longitude3, t)));
  const double beta = -sumOf(latitude0, t);
  const double distance = sumOf(distance0, t) + t * sumOf(distance1, t);

  const Nutation nutation = nutationAt(centuryTerrestrial);
  const double epsilon = glm::radians(meanObliquity(t / 10.0) + nutation.obliquityDegrees);
  const double aberration = -20.4898 / 3600.0 / distance;
  const double lambda =
    heliocentric + glm::pi<double>() + glm::radians(nutation.longitudeDegrees + aberration);

  const double siderealDegrees = 280.46061837 + 360.98564736629 * (view.julianDay - julianDay2000) +
    century * century * (0.000387933 - century / 38710000.0) +
    nutation.longitudeDegrees * std::cos(epsilon);
  const double rightAscension = std::atan2(
    std::sin(lambda) * std::cos(epsilon) - std::tan(beta) * std::sin(epsilon), std::cos(lambda));
  const double declination = std::asin(glm::clamp(
    std::sin(beta) * std::cos(epsilon) + std::cos(beta) * std::sin(epsilon) * std::sin(lambda),
    -1.0, 1.0));
  const double hourAngle =
    glm::radians(turned(siderealDegrees + view.longitudeDegrees)) - rightAscension;

  // Parallax, at most 9 arc seconds: the observer stands on the ellipsoid, not at its centre.
  const double latitude = glm::radians(view.latitudeDegrees);
  const double parallax = glm::radians(8.794 / 3600.0 / distance);
  const double reduced = std::atan2(0.99664719 * std::sin(latitude), std::cos(latitude));
  const double altitude = view.altitudeMetres / 6378140.0;
  const double across = std::cos(reduced) + altitude * std::cos(latitude);
  const double along = 0.99664719 * std::sin(reduced) + altitude * std::sin(latitude);
  // The sun's declination is at most 24 degrees, so the second arguments are positive.
  const double towards = std::cos(declination) - across * std::sin(parallax) * std::cos(hourAngle);
  const double shift = std::atan2(-across * std::sin(parallax) * std::sin(hourAngle), towards);
  const double declinationSeen =
    std::atan2((std::sin(declination) - along * std::sin(parallax)) * std::cos(shift), towards);
  const double hourAngleSeen = hourAngle - shift;

  const double sine = std::sin(latitude) * std::sin(declinationSeen) +
    std::cos(latitude) * std::cos(declinationSeen) * std::cos(hourAngleSeen);
  // At the zenith both are 0, and atan2 returns an arbitrary azimuth.
  const double azimuthFromSouth = std::atan2(std::sin(hourAngleSeen) * std::cos(declinationSeen),
    std::cos(hourAngleSeen) * std::sin(latitude) * std::cos(declinationSeen) -
      std::sin(declinationSeen) * std::cos(latitude));
  return { turned(glm::degrees(azimuthFromSouth) + 180.0),
    glm::degrees(std::asin(glm::clamp(sine, -1.0, 1.0))), glm::degrees(declinationSeen), distance };
}

double refractionDegrees(double elevationDegrees, double pressureMillibar, double celsius)
{
  constexpr double radiusAndRefraction = 0.26667 + 0.5667;
  if (elevationDegrees < -radiusAndRefraction)
  {
    return 0.0;
  }
  const double lifted = elevationDegrees + 10.3 / (elevationDegrees + 5.11);
  return pressureMillibar / 1010.0 * 283.0 / (273.0 + celsius) * 1.02 /
    (60.0 * std::tan(glm::radians(lifted)));
}

double julianDayOf(int year, int month, int day)
{
  if (month <= 2) // counts as a month of the previous year
  {
    year -= 1;
    month += 12;
  }
  const double century = std::floor(year / 100.0);
  return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + day + 2.0 -
    century + std::floor(century / 4.0) - 1524.5;
}

int daysOfMonth(int year, int month)
{
  constexpr std::array<int, 12> days = { 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
  const bool leaps = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return days[static_cast<std::size_t>(month - 1)] + (month == 2 && leaps ? 1 : 0);
}

} // namespace gnomon
