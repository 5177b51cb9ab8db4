#pragma once

#include "FrameTiming.h"

#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// One contender in one case.
struct GrowthMeasurement
{
  std::string notDrawn; ///< the reason; empty if it is drawn
  double firstMilliseconds = 0.0;
  std::vector<double> times; ///< of the frames that count, in milliseconds
  FrameReport report;        ///< of the last frame; empty for contenders that are not Gnomon's

  bool isDrawn() const { return this->notDrawn.empty(); }
  double milliseconds() const { return median(this->times); }
};

/// A case of an axis.
struct GrowthRow
{
  std::string name;
  double x;                                ///< its place on the axis; 0: the axis has no scale
  std::vector<GrowthMeasurement> measured; ///< by contender

  /// Return a contender's time as a multiple of plain VTK's; nothing if one of them is not drawn.
  std::optional<double> overPlain(std::size_t contender) const;
};

struct GrowthAxis
{
  std::string key;
  std::vector<GrowthRow> rows;

  bool hasScale() const { return this->rows.front().x > 0.0; }
};

/// All data of GrowthBenchmark.cpp's report.
struct Growth
{
  std::string command;
  std::string machine;
  std::string scene;                   ///< the base scene of all axes, as a sentence
  std::vector<std::string> contenders; ///< plain VTK, vtkShadowMapPass, Gnomon's
  std::vector<GrowthAxis> axes;
};

/// Write growth.md and growth.csv into the folder, and growth.png if an axis has a scale.
/// @throws Failure if writing fails
void writeGrowth(const Growth& growth, const std::string& folder);

} // namespace gnomon::tool
