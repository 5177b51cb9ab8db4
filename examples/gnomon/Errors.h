#pragma once

#include <stdexcept>

namespace gnomon::tool
{

/// What the user gave cannot be used. The message names the file, the place in it, what stands
/// there and what was expected. The program ends with exit code 2.
class BadInput : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The input was fine, but the work failed (a context that cannot be made, a disk that is full).
/// The program ends with exit code 1.
class Failure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

} // namespace gnomon::tool
