#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>

namespace gnomon
{

/// Return the line that gives a macro of GLSL an integer's value.
inline std::string glslDefine(const std::string& name, int value)
{
  return "#define " + name + " " + std::to_string(value) + "\n";
}

/// Return a finite number as GLSL's text, to nine digits. It does not depend on the program's
/// locale, whose decimal point may be a comma.
inline std::string glslNumber(double value)
{
  std::array<char, 32> text{};
  const std::to_chars_result result =
    std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 8);
  return { text.data(), result.ptr };
}

/// Return the line that defines a macro as a finite number.
inline std::string glslDefine(const std::string& name, double value)
{
  return "#define " + name + " float(" + glslNumber(value) + ")\n";
}

inline std::string glslElement(const std::string& name, std::size_t index)
{
  return name + "[" + std::to_string(index) + "]";
}

} // namespace gnomon
