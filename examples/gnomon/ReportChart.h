#pragma once

#include "ErrorFront.h"
#include "ImageFile.h"

#include <array>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// A tick of a logarithmic axis. Its coordinate is the value's decimal logarithm.
struct LogTick
{
  double position = 0.0;
  std::string label;
};

/// The range and ticks of a logarithmic axis for values >= 0. Zero has no logarithm, so its tick
/// "0" lies one decade below the smallest decade.
class LogScale
{
public:
  /// @param values values that the axis shows; at least one
  /// @param unit appended to every label but zero's, e.g. " %"
  LogScale(const std::vector<double>& values, const std::string& unit);

  /// Return a value's axis coordinate.
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

/// Draw frames' milliseconds (y) over a quantity (x), both logarithmic: one line for each entry
/// with points, its name at the last one.
/// @throws Failure without an OpenGL context
Picture drawTimes(const std::vector<ChartLine>& lines);

/// One way to render shadows in a chart of error over time.
struct ChartWay
{
  std::string name;
  ErrorAndTime of;
};

/// Draw error over time, both logarithmic. The Pareto front is coloured, joined and labelled. Other
/// ways are grey points.
/// @param timeTitle, errorTitle the axes' titles
/// @param timeUnit, errorUnit appended to the axes' labels, e.g. " %"
/// @throws Failure without an OpenGL context
Picture drawFront(const std::vector<ChartWay>& ways, const std::string& timeTitle,
  const std::string& timeUnit, const std::string& errorTitle, const std::string& errorUnit);

} // namespace gnomon::tool
