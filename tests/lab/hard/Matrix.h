#pragma once

#include "Flicker.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::hard
{

/// How a cell is judged.
enum class Kind
{
  Truth,  ///< agrees with the independent check (tests/check/Check.h)
  Offset, ///< the truth agrees with that of half and double ray offsets
  Exact,  ///< no pixel differs from ray tracing
  Map,    ///< wrong pixels lie near a shadow's edge
  Plane,  ///< the same, on the floor alone
  Soft    ///< errs little more than on easy scenes
};

/// Bounds for techniques on hard cases, fixed before the cases are drawn. In all cases numbers are
/// finite and in [0, 1], and neither OpenGL nor VTK reports an error.
namespace bounds
{

///@{
/// For hard shadows: pixels of the picture, texels of the maps.
constexpr int width = 320;
constexpr int height = 240;
constexpr int mapSizeTexels = 512;
///@}
///@{
/// For soft shadows.
constexpr int softWidth = 96;
constexpr int softHeight = 72;
constexpr int truthSamples = 1024; ///< of the truth; techniques have their default
///@}

/// Wrong pixels of maps lie within this many texels of a shadow's edge, in texels of a uniform map
/// of the whole scene. A surface no wider than this in the map, at any map size, counts as edge.
constexpr double edgeTexels = 2.0;

/// The truth changes only within this many pixels of a shadow's edge, with another offset or with
/// another tracer on round balls.
constexpr double truthEdgePixels = 0.5;

/// The bound of soft shadows' mean absolute error, over that of the technique on easy scenes.
constexpr double softFactor = 2.0;

/// Mean absolute errors on the easy scenes, as `gnomon_hard_cases --easy` prints them.
inline const std::map<std::string, double>& easyErrors()
{
  static const std::map<std::string, double> errors = { { "pcss", 0.0031 }, { "sampled", 0.0018 },
    { "montecarlo", 0.0035 } };
  return errors;
}

/// The bound of flicker (Flicker.h), the share of edge pixels that turn right or wrong between
/// frames. It is relative to `nsm` under a turning light. Exact techniques: 0.
constexpr double flickerFactor = 2.0;

} // namespace bounds

/// A column of the matrix: a technique, and how it is judged.
struct Column
{
  std::string name;      ///< as displayed
  std::string technique; ///< with settings, as in `gnomon compare`
  Kind kind;
};
const std::vector<Column>& columns();

/// A row: a scene, or a movement.
struct Row
{
  std::string name;
  std::optional<Movement> movement = {};
};
const std::vector<Row>& rows();

enum class Outcome
{
  Kept,
  Broken,
  Refused, ///< the technique refuses the projection with an error
  None     ///< the row does not apply to this column
};

/// The result of one cell.
struct Cell
{
  const Row* row = nullptr;       ///< one of rows()
  const Column* column = nullptr; ///< one of columns()
  Outcome outcome = Outcome::None;
  std::int64_t counted = 0; ///< pixels that face a light
  std::int64_t wrong = 0;   ///< of these
  std::int64_t beyond = 0;  ///< wrong ones where none is allowed
  double error = 0.0;       ///< mean absolute error of soft shadows; share of edges that flicker
  double bound = 0.0;       ///< of the error
  std::string message = {}; ///< why it is broken or refused
};

/// Draw one row's cells of some columns.
/// @param row,columns of rows() and columns()
/// @throws tool::Failure if the scene cannot be drawn
std::vector<Cell> drawRow(const Row& row, const std::vector<const Column*>& columns);

/// Return the mean absolute error of a soft technique on the easy scenes. Its bound on hard scenes
/// follows from that.
double easyError(const Column& column);

/// Return a cell as a line of a CSV table; return the table's first line.
std::string csvLine(const Cell& cell);
std::string csvHeading();

/// Cells that are known to be broken, by row and column, with the reason.
using KnownCells = std::map<std::pair<std::string, std::string>, std::string>;
/// Read lines of row, column and reason, separated by tabs; "#" begins a comment.
/// @throws tool::BadInput naming the file and the line
KnownCells readKnownCells(const std::string& path);

/// Return one sentence for each broken cell that is not known to be, and for each known one that is
/// not broken.
std::vector<std::string> surprisesIn(const std::vector<Cell>& cells, const KnownCells& known);

/// Write hard_cases.csv into a folder.
/// @throws tool::Failure
void writeTable(const std::string& folder, const std::vector<Cell>& cells);

} // namespace gnomon::hard
