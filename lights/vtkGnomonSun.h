/**
 * @class   vtkGnomonSun
 * @brief   the sun's direction from a date, a time, a zone and a place
 *
 * @code
 * vtkNew<vtkGnomonSun> sun;
 * sun->SetDate(2026, 6, 21);
 * sun->SetTime(9, 30, 0.0, 2.0); // 9:30, two hours east of UTC: summer time in Berlin
 * sun->SetPlace(52.52, 13.405);
 * double towards[3];
 * sun->GetDirection(towards);
 * light->SetPosition(towards);   // a directional vtkLight with its focal point in the origin
 * @endcode
 *
 * Positions follow the Solar Position Algorithm (Reda and Andreas, Solar Energy 76, 2004; revised
 * 2008), without periodic terms below 2e-6 radians. With the right DeltaT, they are within 0.001
 * degrees of the full theory (VSOP87) in the years 1583 to 3000. With the default DeltaT, they are
 * within 0.003 degrees in 1900 to 2100. They are positions of the centre of the sun's disc, for an
 * observer on the ground.
 *
 * The scene's axes are given by North and Up. By default +y is north, +z is up and +x is east.
 *
 * Invalid input (30 February, a latitude of 91 degrees, North along Up, a number that is not
 * finite) is an error (vtkErrorMacro) and changes nothing.
 *
 * @sa vtkGnomonVisibilityFilter
 */

#ifndef vtkGnomonSun_h
#define vtkGnomonSun_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkGnomonVersions.h"  // For VTK_ABI_NAMESPACE_BEGIN
#include "vtkObject.h"
#include "vtkWrappingHints.h" // For VTK_EXPECTS

VTK_ABI_NAMESPACE_BEGIN
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

class GNOMONLIGHTS_EXPORT vtkGnomonSun : public vtkObject
{
public:
  static vtkGnomonSun* New();
  vtkTypeMacro(vtkGnomonSun, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The date in the Gregorian calendar, in the time zone of SetTime(). Years are in [1583, 6000];
   * months and days count from 1. Default: 2000-03-20.
   */
  virtual void SetDate(int year, int month, int day);
  vtkGetMacro(Year, int);
  vtkGetMacro(Month, int);
  vtkGetMacro(Day, int);
  ///@}

  ///@{
  /**
   * The time of day, and its zone in hours east of UTC, in [-14, 14]. Daylight saving time is part
   * of the zone. Hours are in [0, 24], minutes and seconds in [0, 60). Default: 12:00:00 UTC.
   */
  virtual void SetTime(int hour, int minute, double second, double zoneHours);
  vtkGetMacro(Hour, int);
  vtkGetMacro(Minute, int);
  vtkGetMacro(Second, double);
  vtkGetMacro(ZoneHours, double);
  ///@}

  ///@{
  /**
   * The place, in degrees: latitude to the north in [-90, 90], longitude to the east in
   * [-180, 360]. Default: 0, 0.
   */
  virtual void SetPlace(double latitude, double longitude);
  vtkGetMacro(Latitude, double);
  vtkGetMacro(Longitude, double);
  ///@}

  ///@{
  /**
   * Height above sea level in metres, in [-1000, 100000]. It moves the sun by less than 0.0001
   * degrees on any mountain. Default: 0.
   */
  virtual void SetAltitude(double metres);
  vtkGetMacro(Altitude, double);
  ///@}

  ///@{
  /**
   * Terrestrial time minus UTC, in seconds, in [-100000, 100000]. Ten seconds move the sun by
   * 0.0001 degrees. Default: 69, right within 5 seconds from 2003 to 2026.
   */
  virtual void SetDeltaT(double seconds);
  vtkGetMacro(DeltaT, double);
  ///@}

  ///@{
  /**
   * Refraction: true to include the air's refraction, which lifts the sun by half a degree at the
   * horizon. SetAir() sets the pressure in millibar, in [0, 5000], and the temperature in degrees
   * Celsius, in [-200, 1000]. Default: off; 1010, 10.
   */
  vtkSetMacro(Refraction, bool);
  vtkGetMacro(Refraction, bool);
  vtkBooleanMacro(Refraction, bool);
  virtual void SetAir(double pressureMillibar, double celsius);
  vtkGetMacro(Pressure, double);
  vtkGetMacro(Temperature, double);
  ///@}

  ///@{
  /**
   * The scene's directions to the north and upwards, of any length. The part of North along Up is
   * ignored. Parallel directions are an error. Default: north (0, 1, 0), up (0, 0, 1).
   */
  virtual void SetNorthAndUp(const double north[3], const double up[3]);
  vtkGetVector3Macro(North, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  /**
   * Return the sun's azimuth in degrees, in [0, 360): 0 is north, 90 is east.
   */
  double GetAzimuth();

  /**
   * Return the elevation of the sun's centre above the horizon, in degrees, with refraction if that
   * is on.
   */
  double GetElevation();

  /**
   * Return the sun's declination in degrees, as seen from the place.
   */
  double GetDeclination();

  /**
   * Return the unit vector from the scene towards the sun, in world coordinates.
   */
  void GetDirection(double direction[3]);

  /**
   * Fill arrays with the suns of a day, from midnight to midnight in the zone. Each step of
   * `stepMinutes` has the sun of its middle. Steps with the sun below the horizon are skipped.
   *
   * @param stepMinutes in (0, 1440]
   * @param directions receives a unit vector towards each sun (3 components)
   * @param hours receives the hours that each sun represents; may be null
   * @param times receives each sun's hours since the first midnight; may be null
   * @return false, with an error and unchanged arrays, for an invalid step or null `directions`
   */
  bool MakeDayPath(double stepMinutes, vtkDoubleArray* directions, vtkDoubleArray* hours,
    vtkDoubleArray* times = nullptr) VTK_EXPECTS(directions != nullptr);

  /**
   * Fill arrays with the suns of the date's whole year, as MakeDayPath() does for a day.
   *
   * @param dayStep in [1, 366]; so many days share the suns of their middle day, and 1 gives every
   * day its own suns
   * @param stepMinutes, directions, hours, times as in MakeDayPath()
   * @return false as MakeDayPath()
   */
  bool MakeYearPath(int dayStep, double stepMinutes, vtkDoubleArray* directions,
    vtkDoubleArray* hours, vtkDoubleArray* times = nullptr) VTK_EXPECTS(directions != nullptr);

protected:
  vtkGnomonSun() = default;
  ~vtkGnomonSun() override = default;

  int Year = 2000;
  int Month = 3;
  int Day = 20;
  int Hour = 12;
  int Minute = 0;
  double Second = 0.0;
  double ZoneHours = 0.0;
  double Latitude = 0.0;
  double Longitude = 0.0;
  double Altitude = 0.0;
  double DeltaT = 69.0;
  bool Refraction = false;
  double Pressure = 1010.0;
  double Temperature = 10.0;
  double North[3] = { 0.0, 1.0, 0.0 };
  double Up[3] = { 0.0, 0.0, 1.0 };

private:
  vtkGnomonSun(const vtkGnomonSun&) = delete;
  void operator=(const vtkGnomonSun&) = delete;

  struct Path;
  double Midnight() const;
  double Now() const;
  bool IsStep(double stepMinutes, vtkDoubleArray* directions);
  void AddDay(Path& path, double julianDay, double days, double hoursBefore) const;
};

#endif
