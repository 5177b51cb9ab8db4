#pragma once

#include "ErrorFront.h"
#include "ImageFile.h"

#include <array>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// A tick of an axis whose coordinate is the decimal logarithm of the value.
struct LogTick
{
  double position = 0.0;
  std::string label;
};

/// The range and ticks of a logarithmic axis for values of 0 or more. Zero has no logarithm: it
/// gets a place of its own, one decade below the smallest decade, with the label "0".
class LogScale
{
public:
  /// @param values what the axis has to show; at least one
  /// @param unit appended to every label but zero's, e.g. " %"
  LogScale(const std::vector<double>& values, const std::string& unit);

  /// The axis coordinate of a value.
  double position(double value) const;
  double lower() const { return this->lower_; }
  double upper() const { return this->upper_; }
  const std::vector<LogTick>& ticks() const { return this->ticks_; }

private:
  double lower_ = 0.0;
  double upper_ = 1.0;
  double zero_ = 0.0;
  std::vector<LogTick> ticks_;
};

/// A line of a chart.
struct ChartLine
{
  std::string name;
  std::vector<std::array<double, 2>> points;
};

/// Frames' milliseconds (y) over a quantity (x), both logarithmic: a line for each that has points,
/// its name at the last one.
/// @throws Failure when no OpenGL context can be made
Picture drawTimes(const std::vector<ChartLine>& lines);

/// One way to draw shadows in a chart of error over time.
struct ChartWay
{
  std::string name;
  ErrorAndTime of;
};

/// Error over time, both logarithmic. The Pareto front is coloured, joined and labelled; other ways
/// are grey points.
/// @param timeTitle, errorTitle what the axes say
/// @param timeUnit, errorUnit appended to their labels, e.g. " %"
/// @throws Failure when no OpenGL context can be made
Picture drawFront(const std::vector<ChartWay>& ways, const std::string& timeTitle,
  const std::string& timeUnit, const std::string& errorTitle, const std::string& errorUnit);

} // namespace gnomon::tool
