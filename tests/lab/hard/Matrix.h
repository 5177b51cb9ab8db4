#pragma once

#include "Bounds.h"
#include "Flicker.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::hard
{

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

/// Return the mean absolute error of a soft technique on the easy scenes. Bounds.h bounds the error
/// on hard scenes by it.
double easyError(const Column& column);

} // namespace gnomon::hard
