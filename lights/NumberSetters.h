#pragma once

#include "vtkObject.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{

/// Set numbers of an object, which is modified if that changes them.
inline void assign(vtkObject* object, double* numbers, const double* values, int count = 1)
{
  if (!std::equal(values, values + count, numbers))
  {
    std::copy_n(values, count, numbers);
    object->Modified();
  }
}

/// Set a number of an object in [least, most]. Any other is an error and changes nothing.
inline void setWithin(
  vtkObject* object, const char* name, double value, double least, double most, double& number)
{
  if (!(value >= least && value <= most))
  {
    vtkErrorWithObjectMacro(object, << name << " was to be " << value << ", expected a number in ["
                                    << least << ", " << most << "].");
    return;
  }
  assign(object, &number, &value);
}

/// Set a number of an object, clamped as by vtkSetClampMacro. NaN is an error and changes nothing.
inline void setClamped(
  vtkObject* object, const char* name, double value, double least, double most, double& number)
{
  setWithin(object, name, std::clamp(value, least, most), least, most, number); // NaN stays NaN
}

/// Set a vector of an object. A squared length that is not finite is an error and changes nothing.
inline void setFinite(
  vtkObject* object, const char* name, double x, double y, double z, double (&vector)[3])
{
  if (!std::isfinite(x * x + y * y + z * z))
  {
    vtkErrorWithObjectMacro(object,
      << name << " was to be (" << x << ", " << y << ", " << z << "), expected finite numbers.");
    return;
  }
  const double given[3] = { x, y, z };
  assign(object, vector, given, 3);
}

} // namespace gnomon
