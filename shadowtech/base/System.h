#pragma once

#include <array>

// Questions to the operating system. System<CMAKE_SYSTEM_NAME>.cpp answers them.

namespace gnomon
{

/// Return the bytes of memory that are available; infinity if the system does not report them.
double availableBytes();

/// Return a text that processes on one machine have in common: its name, and the number of its
/// start, as containers on several machines may have one name.
std::array<char, 512> nameOfMachine();

/// Return this process's number, which a forked process does not share.
long processNumber();

} // namespace gnomon
