#pragma once

#include <stdexcept>

namespace gnomon::tool
{

inline constexpr int badInputCode = 2;

/// Invalid input by the user. The message names the file, the place in it, the value found and the
/// value expected. The program ends with badInputCode.
class BadInput : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A failure with valid input, for example without an OpenGL context or on a full disk. The program
/// ends with exit code 1.
class Failure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

} // namespace gnomon::tool
